"""What each part of a scene costs: operations and microseconds per Newton iteration with and without it, side by side
on one core.    python -m benchmarks.scene_cost

The scenes, the counting and the timing are those of `campaigns.stability.scene_shares`, which puts them into the
report.
"""

from campaigns.stability.scene_shares import TABLE_1, measured


def main():
    scenes = measured()["scenes"]
    whole = scenes[TABLE_1]
    for name, cost in scenes.items():
        time_share, share = cost["us_per_newton"] / whole["us_per_newton"], cost["newton"] / whole["newton"]
        print(
            f"{name:34s} {cost['us_per_newton']:6.2f} us, {cost['newton']:6d} operations per Newton iteration   "
            f"{time_share:5.2f} and {share:5.2f} of Table 1"
        )


if __name__ == "__main__":
    main()
