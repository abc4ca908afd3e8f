"""Eigenvalues of small matrices, for contracts, which know no numerical library."""

from collections.abc import Sequence

Matrix = Sequence[Sequence[float]]

_ROUNDS = 200
_SETTLED = 1e-14


def eigenvalues(matrix: Matrix) -> list[complex]:
    """Return the eigenvalues of a real square matrix of a few rows.

    They are the roots of the characteristic polynomial (Faddeev and LeVerrier), found all at once
    (Durand, 1960; Kerner, 1966): good to a millionth or so where roots nearly meet.
    """
    size = len(matrix)
    scale = max((abs(item) for row in matrix for item in row), default=0.0)
    if scale == 0:
        return [0j] * size
    scaled = [[item / scale for item in row] for row in matrix]
    polynomial = _characteristic(scaled)
    roots = [complex(0.4, 0.9) ** power for power in range(1, size + 1)]
    for _ in range(_ROUNDS):
        change = 0.0
        for index, root in enumerate(roots):
            value, others = complex(1), complex(1)
            for coefficient in polynomial:
                value = value * root + coefficient
            for other, neighbour in enumerate(roots):
                others *= root - neighbour if other != index else 1
            step = value / others if others else complex(1e-3, 1e-3)
            roots[index] = root - step
            change = max(change, abs(step))
        if change < _SETTLED:
            break
    return [root * scale for root in roots]


def _characteristic(matrix: Matrix) -> list[float]:
    """Return the coefficients after the leading 1 of det(x - matrix)."""
    size = len(matrix)
    coefficients: list[float] = []
    power = [[float(row == column) for column in range(size)] for row in range(size)]
    for order in range(1, size + 1):
        power = [
            [sum(matrix[row][k] * power[k][column] for k in range(size)) for column in range(size)]
            for row in range(size)
        ]
        coefficient = -sum(power[row][row] for row in range(size)) / order
        coefficients.append(coefficient)
        for row in range(size):
            power[row][row] += coefficient
    return coefficients
