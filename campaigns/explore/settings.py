"""What shapes the rows of all explorers: files of this project, and settings of an order."""

from campaigns.study import Order

ROW_SOURCES = ("analysis", "engine", "campaigns/explore", "campaigns/judge.py")


def settings_of(order: Order) -> dict[str, int | None]:
    """How a row is made: transient_periods, full of `rows.buoy_row`."""
    full = order.options.evidence == "full"
    return {"transient_periods": order.transient, "full": order.periods if full else None}
