"""What the site adds to the pages of the repository: formulas as MathML, the notebook, and the public names of Python.

MathML needs no script, so the pages can be read without a network.
"""

import html
import importlib
import inspect
import json
import re
from pathlib import Path

from latex2mathml.converter import convert
from mkdocs.structure.files import File

ROOT = Path(__file__).resolve().parents[2]
NOTEBOOK = "docs/first_run"
FIRST = (("engine", "load_scene"), ("engine", "simulate"), ("campaigns.sweep", "sweep"), ("engine", "Trajectory"))
PACKAGES = ("engine", "analysis", "analysis.oscillator")


def on_files(files, config):
    """Add the pages that are made: the notebook, and the names with their docstrings."""
    notebook = json.loads((ROOT / f"{NOTEBOOK}.ipynb").read_text(encoding="utf-8"))
    files.append(File.generated(config, f"{NOTEBOOK}.md", content="\n\n".join(map(cell, notebook["cells"]))))
    files.append(File.generated(config, "docs/api.md", content=python_page()))
    return files


def on_page_markdown(markdown, **_):
    """Formulas between dollars, or in a block, as MathML; code keeps its dollars. The notebook is a page here."""
    markdown = markdown.replace(".ipynb)", ".md)")
    blocks = re.split(r"(^```math\n.*?^```$|^```.*?^```$|`[^`\n]+`)", markdown, flags=re.DOTALL | re.MULTILINE)
    return "".join(map(formulas, blocks))


def formulas(text):
    """A block of a page with its formulas as MathML."""
    if text.startswith("```math"):
        return f"<div>{mathml(text[7:-3], 'block')}</div>"
    return text if text.startswith("`") else re.sub(r"\$([^$\n]+)\$", lambda match: mathml(match[1]), text)


def mathml(tex, display="inline"):
    """A formula as MathML on one line; in a span, or a formula that begins a line would be a block of its own."""
    tex = re.sub(r"\\tag\{(.*?)\}", r"\\qquad (\1)", tex).replace("{aligned}", "{align*}")
    return f"<span>{convert(' '.join(tex.split()), display=display)}</span>"


def cell(notebook_cell):
    """A cell of a notebook as Markdown, with what it printed and drew."""
    source = "".join(notebook_cell["source"])
    if notebook_cell["cell_type"] == "markdown":
        return source
    parts = [f"```python\n{source}\n```"]
    for output in notebook_cell["outputs"]:
        data = output.get("data", {})
        if "image/png" in data:
            parts.append(f'<img alt="figure" src="data:image/png;base64,{"".join(data["image/png"]).strip()}">')
        elif "text/html" in data:
            parts.append("".join(data["text/html"]))
        else:
            parts.append(f"```text\n{''.join(output.get('text', data.get('text/plain', [])))}\n```")
    return "\n\n".join(parts)


def python_page():
    """The public names with signatures and docstrings: first those with which everybody begins, then the others."""
    beginning = (
        "A scene is loaded, simulated or swept; a `Trajectory` is what a run left, with everything to look at it."
    )
    parts = ["# Python", "## To begin with", beginning]
    for package, name in FIRST:
        parts += entry(f"{package}.{name}", getattr(importlib.import_module(package), name))
    for package in PACKAGES:
        module = importlib.import_module(package)
        parts += [f"## {package}", inspect.getdoc(module).partition("\n")[0]]
        for name in sorted(set(module.__all__) - {name for first, name in FIRST if first == package}):
            parts += entry(f"{package}.{name}", getattr(module, name))
    return "\n\n".join(parts)


def signature(function):
    """The parameters of a function, without those that only Tab is told of (`load_scene`)."""
    whole = inspect.signature(function)
    written = function.__code__.co_varnames
    shown = [entry for name, entry in whole.parameters.items() if name in written]
    rest = ", ...)" if len(shown) < len(whole.parameters) else ")"
    return str(whole.replace(parameters=shown, return_annotation=inspect.Signature.empty))[:-1] + rest


def entry(name, item):
    """Heading, signature and docstring of a function or class, and of the methods written in it."""
    docstring = inspect.getdoc(item) or ""
    parts = [f"### {name}"]
    if inspect.isfunction(item):
        parts.append(f"<code>{html.escape(name.rpartition('.')[2] + signature(item))}</code>")
    parts.append(f"<pre>{html.escape(docstring)}</pre>")
    if inspect.isclass(item):
        for key, method in vars(item).items():
            method = getattr(method, "__func__", method)
            if inspect.isfunction(method) and not key.startswith("_") and method.__doc__:
                parts += entry(f"{name}.{key}", method)
    return parts
