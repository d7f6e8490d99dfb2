"""The page needs nothing but itself, and says in words what its figures show."""

import re


def test_nothing_is_fetched(built, page):
    tags = [tag for tag, _ in page.tags]
    assert "link" not in tags and "iframe" not in tags
    for tag, attributes in page.tags:
        assert attributes.get("src", "data:").startswith("data:"), tag
        assert attributes.get("href", "#").startswith("#"), tag
        assert not [name for name in attributes if name.startswith("on")], tag
    assert not [attributes for tag, attributes in page.tags if tag == "script" and "src" in attributes]
    source = re.sub(r"base64,[A-Za-z0-9+/=]+", "", built[0].read_text(encoding="utf-8"))
    assert "http" not in source and "url(" not in source and "@import" not in source
    assert not re.search(r"\b(fetch|XMLHttpRequest|WebSocket|EventSource|sendBeacon|eval|Function|import)\(", source)


def test_every_link_and_glyph_has_its_target_and_ids_are_unique(page):
    ids = [attributes["id"] for _, attributes in page.tags if "id" in attributes]
    assert len(ids) == len(set(ids))
    used = {attributes["href"][1:] for _, attributes in page.tags if "href" in attributes}
    assert used and used <= set(ids)


def test_every_figure_has_a_caption_and_a_text_alternative(page):
    tags = [tag for tag, _ in page.tags]
    images = [attributes for tag, attributes in page.tags if tag == "img"]
    assert len(images) == tags.count("figure") == tags.count("figcaption") >= 8
    assert all(len(image["alt"].split()) >= 5 for image in images)
    equations = [attributes for tag, attributes in page.tags if tag == "svg"]
    assert len(equations) == 5 + 7, "five equations, a drawing of each run with a record"
    assert all(svg["role"] == "img" and len(svg["aria-label"].split()) >= 5 for svg in equations)
