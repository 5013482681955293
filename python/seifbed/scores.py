"""Scores of anybody's results."""

import json
from typing import Mapping, Optional, Union

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from . import _seifbed

Table = Union[ArrayLike, pd.DataFrame]
Points = Union[Mapping[int, ArrayLike], pd.DataFrame]

_none = np.zeros((0, 2))


def _rows(table, columns, what):
    """The values of a table or of an array with these columns."""
    if isinstance(table, pd.DataFrame):
        missing = [name for name in columns if name not in table]
        if missing:
            raise ValueError(f"{what} lacks the columns {', '.join(missing)}")
        table = table[columns]
    return np.asarray(table, dtype=float)


def _landmarks(points, what):
    """(ids, positions (n, 2)) of a dictionary {landmark: (x, y)} or of a table with landmark, x, y."""
    if points is None:
        return np.zeros(0, dtype=np.int64), _none
    if isinstance(points, pd.DataFrame):
        return points["landmark"].to_numpy(), _rows(points, ["x", "y"], what)
    ids = np.asarray(list(points), dtype=None if points else np.int64)
    return ids, np.asarray(list(points.values()), dtype=float).reshape(-1, 2) if points else _none


def score(truth: Table, landmarks: Optional[Points] = None, trajectory: Optional[Table] = None,
          map: Optional[Points] = None, covariances: Optional[dict[str, ArrayLike]] = None, name: str = "estimate",
          rpe_s: float = 1.0) -> pd.Series:
    """Scores a trajectory and a map that any program has estimated. Returns a Series with the keys of docs/scores.md.

    truth        (n, 4) t, x, y, theta, or a table with these columns: the true poses; interpolated between two
    landmarks    the true landmarks: {landmark: (x, y)}, or a table with landmark, x, y
    trajectory   (m, 4) or a table, as truth
    map          as landmarks
    covariances  {"poses": (m, 3, 3), "landmarks": (k, 2, 2)}, either may be missing; NaN where one is not known
    rpe_s        time over which the relative pose error is measured [s]

    Raises BadInput if nothing can be compared, and ValueError for wrong shapes.
    """
    if trajectory is None and map is None:
        raise ValueError("there is neither a trajectory nor a map to score")
    if not 0 < rpe_s < float("inf"):
        raise ValueError("rpe_s must be above zero")
    known = dict(covariances or {})
    poses, points = known.pop("poses", None), known.pop("landmarks", None)
    if known:
        raise ValueError(f"covariances: there is no {sorted(known)[0]!r}; use 'poses' and 'landmarks'")
    pose_columns = ["t", "x", "y", "theta"]
    true_ids, true_points = _landmarks(landmarks, "landmarks")
    ids, means = _landmarks(map, "map")
    text = _seifbed.score(
        name, _rows(truth, pose_columns, "truth"),
        np.zeros((0, 4)) if trajectory is None else _rows(trajectory, pose_columns, "trajectory"), poses,
        true_ids, true_points, ids, means, points, float(rpe_s))
    return pd.Series(json.loads(text))
