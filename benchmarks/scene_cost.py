"""What each part of a scene costs: microseconds of a Newton iteration with and without it, side by side.

    python -m benchmarks.scene_cost [--core N]

Scenes and timing are those of `campaigns.stability.scene_shares`, which puts them into the report of that campaign.
"""

from benchmarks.shared import on_one_core, parser, print_load
from campaigns.stability.scene_shares import TABLE_1, measured


def main() -> None:
    on_one_core(parser(__doc__, 7).parse_args().core)
    print_load()
    scenes = measured()["scenes"]
    for name, cost in scenes.items():
        share = cost["us_per_newton"] / scenes[TABLE_1]["us_per_newton"]
        print(f"{name:34s} {cost['us_per_newton']:6.2f} us per Newton iteration   {share:5.2f} of Table 1")


if __name__ == "__main__":
    main()
