"""What the tests share."""

import pytest

import seifbed

TINY = {
    "name": "tiny",
    "duration_s": 4,
    "landmarks": {"generators": [{"type": "uniform", "count": 80}]},
    "estimators": {"ekf": {}, "seif": {}},
}


@pytest.fixture
def tiny():
    return seifbed.worlds.from_dict(TINY)


class Odometer:
    """Believes the odometry alone."""

    def __init__(self, start, start_covariance, sensor, **options):
        self.x = start
        self.options = options

    def motion(self, odometry):
        pass

    def measure(self, scan):
        pass

    def pose(self):
        return self.x

    def map(self):
        return {}


@pytest.fixture
def odometer():
    return Odometer
