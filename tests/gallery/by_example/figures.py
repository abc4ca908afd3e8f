"""The figures of all sheets as tables."""

from collections.abc import Mapping

Figures = Mapping[str, Mapping[str, Mapping[str, float | None]]]
"""By exemplar, technique and name."""

MEANS = ("coherent", "verbatim", "longest_run", "repetition", "seam", "seconds")


def table_of_distances(figures: Figures) -> str:
    """Return how near patches are, a row for each technique and a column for each exemplar."""
    techniques = list(next(iter(figures.values())))
    rows = [
        [f"`{technique}`"]
        + [
            f"{_thousandths(found[technique]['to'])}/{_thousandths(found[technique]['from'])}"
            for found in figures.values()
        ]
        for technique in techniques
    ]
    return _table(["to/from exemplar", *figures], rows)


def table_of_means(figures: Figures) -> str:
    """Return the means of the other figures over all exemplars, a row for each technique."""
    rows = []
    for technique in next(iter(figures.values())):
        cells = [f"`{technique}`"]
        for name in MEANS:
            values = [found[technique][name] for found in figures.values()]
            known = [value for value in values if value is not None]
            cells.append(f"{sum(known) / len(known):.3g}" if known else "")
        rows.append(cells)
    return _table(["mean over all", *MEANS], rows)


def _thousandths(value: float | None) -> str:
    return "-" if value is None else f"{value * 1000:.0f}"


def _table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n" + "".join(f"| {' | '.join(line)} |\n" for line in lines)
