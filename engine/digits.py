"""Numbers in the messages of runs: with few digits, and without an exponent where a reader needs none."""


def digits(value: float, count: int) -> str:
    """The value with so many significant digits, as one would say it.

    >>> digits(12345.6, 4), digits(873.4, 2), digits(0.00123, 2)
    ('12350', '870', '0.0012')
    """
    return f"{float(f'{value:.{count}g}'):.12g}"
