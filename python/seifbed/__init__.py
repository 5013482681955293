"""seifbed: a robot testbed for SLAM filters.

    import seifbed
    run = seifbed.run("courtyard", estimators=["ekf", "seif"], seed=1)
    print(run.scores)

Lengths are in metres, angles in radians, times in seconds. A pose is [x, y, theta]. A covariance of a pose and of k
landmarks has the shape (3 + 2k, 3 + 2k), with rows [x y theta m1x m1y ...].
"""

from . import worlds
from ._seifbed import BadInput, NumericalFailure, Odometry, Scan, Stage, __version__
from .environment import Environment, make
from .estimators import estimator, estimators, load_plugin
from .filters import Ekf, Filter, Seif
from .plots import plot
from .runs import Comparison, Run, compare, film, open_run, run, sweep
from .scores import score

__all__ = [
    "BadInput", "Comparison", "Ekf", "Environment", "Filter", "NumericalFailure", "Odometry", "Run", "Scan", "Seif",
    "Stage", "__version__", "compare", "estimator", "estimators", "film", "load_plugin", "make", "open_run", "plot",
    "run", "score", "sweep", "worlds",
]
