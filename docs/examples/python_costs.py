"""What Python costs: ./seifbed python docs/examples/python_costs.py [RESETS]"""

import resource
import sys
import time

import numpy as np

import seifbed


@seifbed.estimator("nothing")
class Nothing:
    """Does nothing."""

    def __init__(self, start, start_covariance, sensor):
        self.x = start

    def motion(self, odometry):
        pass

    def measure(self, scan):
        pass

    def pose(self):
        return self.x

    def map(self):
        return {}


@seifbed.estimator("nothing_too")
class NothingToo(Nothing):
    """Does nothing either."""


def seconds(repetitions, call):
    begin = time.perf_counter()
    for _ in range(repetitions):
        call()
    return (time.perf_counter() - begin) / repetitions


def scan_there_and_back():
    scan = seifbed.Scan(0.0, ids, ranges, bearings, covariances)
    return scan.ids, scan.ranges, scan.bearings, scan.covariances


env = seifbed.make("courtyard", seed=1)
steps = 4000
each = seconds(steps, lambda: env.step((0.5, 0.1)))
print(f"physics steps a second: {env.physics_steps / (steps * each):.0f}")

ids, ranges, bearings = np.arange(10), np.linspace(1, 5, 10), np.linspace(-1, 1, 10)
covariances = np.stack([np.diag([0.01, 0.0004])] * 10)
print(f"a scan there and back: {1e6 * seconds(20_000, scan_there_and_back):.1f} us")

run = seifbed.run("courtyard", estimators=[Nothing])
print(f"an update that does nothing: {run.scores['update_us.p50'][0]:.1f} us")

# All that a run asks of an estimator in Python, by the clock on the wall: what a second one adds.
one = min(seconds(1, lambda: seifbed.run("courtyard", estimators=[Nothing])) for _ in range(5))
two = min(seconds(1, lambda: seifbed.run("courtyard", estimators=[Nothing, NothingToo])) for _ in range(5))
updates = 900
print(f"with pose, covariance and record: {1e6 * (two - one) / updates:.1f} us")

resets = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
seconds(100, env.reset)
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
seconds(resets, env.reset)
after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
print(f"{resets} resets add: {(after - before) / 1024:.1f} MB")
