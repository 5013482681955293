"""A filter alone, on data of your own."""

from typing import Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _seifbed


class Filter:
    """Any filter by its name, with its options (`seifbed estimators` lists them).

    start             (3,) where the robot believes to start
    start_covariance  (3, 3); by default it is nearly certain
    sensor            (3,) where the landmark sensor sits on the robot
    seed              of a filter that draws random numbers
    """

    def __init__(self, name, *, start=(0, 0, 0), start_covariance=None, sensor=(0, 0, 0), seed=1, **options):
        covariance = np.diag([1e-8, 1e-8, 1e-8]) if start_covariance is None else start_covariance
        self._filter = _seifbed.Filter(name, start, covariance, sensor, seed, options)
        self._t = 0.0

    def motion(self, motion: Union[ArrayLike, _seifbed.Odometry], covariance: Optional[ArrayLike] = None,
               t: Optional[float] = None) -> None:
        """Moves the robot: `motion` (3,) in its own frame, with its covariance (3, 3). Or an Odometry."""
        if not isinstance(motion, _seifbed.Odometry):
            if covariance is None:
                raise TypeError("the motion needs a covariance (3, 3)")
            motion = _seifbed.Odometry(self._t if t is None else t, motion, covariance)
        self._t = motion.t
        self._filter.motion(motion)

    def measure(self, ids: Union[ArrayLike, _seifbed.Scan], ranges: Optional[ArrayLike] = None,
                bearings: Optional[ArrayLike] = None, covariances: Optional[ArrayLike] = None,
                t: Optional[float] = None) -> None:
        """Processes a scan: ids (n,), ranges (n,), bearings (n,), covariances (n, 2, 2) or (2, 2). Or a Scan."""
        self._filter.measure(self._scan(ids, ranges, bearings, covariances, t))

    def stages(self, ids: Union[ArrayLike, _seifbed.Scan], ranges: Optional[ArrayLike] = None,
               bearings: Optional[ArrayLike] = None, covariances: Optional[ArrayLike] = None,
               t: Optional[float] = None) -> list[_seifbed.Stage]:
        """Processes a scan as measure() does. Returns what the filter believed after each stage, a list of Stage.

        The first one, `motion`, is what it believed before the scan.
        """
        return self._filter.stages(self._scan(ids, ranges, bearings, covariances, t))

    def _scan(self, ids, ranges, bearings, covariances, t):
        if isinstance(ids, _seifbed.Scan):
            return ids
        if ranges is None or bearings is None or covariances is None:
            raise TypeError("a scan needs ids, ranges, bearings and covariances")
        return _seifbed.Scan(self._t if t is None else t, ids, ranges, bearings, covariances)

    def pose(self) -> np.ndarray:
        """(3,) where the filter believes the robot to be."""
        return self._filter.pose()

    def map(self) -> dict[int, np.ndarray]:
        """{landmark: (2,)}, in the order in which the landmarks joined the map."""
        ids, means = self._filter.map()
        return dict(zip(ids.tolist(), means))

    def covariance(self, ids: ArrayLike = ()) -> Optional[np.ndarray]:
        """(3 + 2k, 3 + 2k) of the pose and these landmarks; None if the filter does not state it."""
        return self._filter.covariance(ids)

    def covariances(self, ids: ArrayLike) -> Optional[tuple[np.ndarray, np.ndarray]]:
        """The marginals: pose (3, 3) and landmarks (k, 2, 2); None if the filter does not state them."""
        return self._filter.covariances(ids)

    def information(self) -> np.ndarray:
        """(3 + 2N, 3 + 2N) the whole matrix that the filter stores: information, or an EKF's covariance."""
        return self._filter.information()

    def counts(self) -> dict:
        """A dictionary of the work so far: blocks_touched, links and others."""
        return self._filter.counts()


class Seif(Filter):
    """Our sparse extended information filter (seif/README.md)."""

    def __init__(self, **options):
        super().__init__("seif", **options)


class Ekf(Filter):
    """The extended Kalman filter."""

    def __init__(self, **options):
        super().__init__("ekf", **options)
