"""A world that you move step by step, shaped as Gymnasium's environments are."""

from typing import Any, Optional

from . import _seifbed, worlds
from .worlds import Settings, WorldLike


class Environment:
    """See make()."""

    def __init__(self, world, seed=None, duration=None, set=None):
        settings = worlds.overrides(set, seed=seed, duration_s=1e6 if duration is None else duration)
        self._world = world  # keeps the file of a world from a dictionary
        self._environment = _seifbed.Environment(worlds.path_of(world), settings)
        self._describe()

    def _describe(self):
        """start (3,), start_covariance (3, 3): what a filter is told; sensor (3,); landmarks (n, 2), the true ones."""
        about = self._environment.description()
        self.start, self.start_covariance = about["start"], about["start_covariance"]
        self.sensor, self.landmarks, self.seed = about["sensor"], about["landmarks"], about["seed"]
        self.name = about["name"]

    def reset(self, seed: Optional[int] = None):
        """Puts the robot to its start, with this seed or the same one again. Returns the first observation: nothing."""
        self._environment.reset(seed)
        self._describe()
        return _Nothing()

    def step(self, action: tuple[float, float]) -> tuple[_seifbed.Measurements, dict[str, Any]]:
        """Moves by action = (v [m/s], omega [rad/s]) until something is measured.

        Returns (observation, truth). observation.t is the time, observation.odometry an Odometry or None,
        observation.scan a Scan or None. truth is a dictionary: t, pose (3,), v, omega, left_wheel, right_wheel.
        Raises StopIteration when the world's duration is over.
        """
        v, omega = action
        measured = self._environment.step(v, omega)
        if measured is None:
            raise StopIteration("the world's duration is over")
        return measured

    def truth(self) -> dict[str, Any]:
        """The true state of the robot now."""
        return self._environment.truth()

    @property
    def physics_steps(self) -> int:
        """Steps of the physics since the start."""
        return self._environment.physics_steps


class _Nothing:
    """The observation before the first step."""

    t = 0.0
    odometry = None
    scan = None


def make(world: WorldLike, seed: Optional[int] = None, duration: Optional[float] = None,
         set: Optional[Settings] = None) -> Environment:
    """A world to be moved step by step: a name of the gallery, a file, or seifbed.worlds.from_dict(...).

        env = seifbed.make("courtyard", seed=1)
        observation = env.reset()
        observation, truth = env.step((0.5, 0.1))

    The same world, seed and commands give the same bits. `set` is a dictionary of settings, as --set of the program.
    Without `duration` it never ends.
    """
    return Environment(world, seed, duration, set)
