"""Worlds: names of the gallery, files, and dictionaries."""

import json
import os
import tempfile
from typing import Any, Iterable, Mapping, Optional, Union

import numpy as np

from . import _seifbed

Path = Union[str, "os.PathLike[str]"]
Settings = Mapping[str, Any]


class World:
    """A world that was made from a dictionary. It can stand wherever a world is asked for."""

    def __init__(self, content):
        self.content = content
        name = str(content.get("name", "world"))
        self._folder = tempfile.TemporaryDirectory(prefix="seifbed_")
        self.path = os.path.join(self._folder.name, "".join(c if c.isalnum() else "_" for c in name) + ".yaml")
        with open(self.path, "w", encoding="utf-8") as file:
            json.dump(content, file, indent=1, allow_nan=True, default=_plain)  # JSON is YAML

    def __fspath__(self):
        return self.path

    def __repr__(self):
        return f"World({self.content.get('name', 'world')!r})"


WorldLike = Union[Path, World]
EstimatorsLike = Union[None, str, type, Iterable[Union[str, type]], Mapping[Union[str, type], Mapping[str, Any]]]


def from_dict(content: dict) -> World:
    """A world from a dictionary with the keys of a world file (worlds/keys.md). It is checked when it is used."""
    if not isinstance(content, dict):
        raise TypeError(f"a world is a dictionary, not {type(content).__name__}")
    return World(content)


def resolved(world: WorldLike, set: Optional[Settings] = None) -> str:
    """The text of a world file with all defaults written out. Raises BadInput with a line for each problem."""
    return _seifbed.resolve(path_of(world), overrides(set))


def path_of(world):
    """The path or the bare name of a world, as text."""
    if isinstance(world, dict):
        raise TypeError("use seifbed.worlds.from_dict(...) for a world from a dictionary, and keep it")
    return os.fspath(world)


def _text(value):
    """A value as YAML."""
    return value if isinstance(value, str) else json.dumps(value, default=_plain)


def _plain(value):
    """A number or an array of numpy as Python's own."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    raise TypeError(f"{value!r} cannot be written to a world file")


def overrides(set=None, **values):
    """Settings such as {"drive.speed_m_s": 1} as the program's --set takes them. A value that is None is left out."""
    chosen = dict(set or {})
    chosen.update({key: value for key, value in values.items() if value is not None})
    return [f"{key}={_text(value)}" for key, value in chosen.items()]


def of_estimators(estimators):
    """The section `estimators` of a world file, from names, classes of Python, or a dictionary of options."""
    if estimators is None:
        return None
    if isinstance(estimators, (str, type)):
        estimators = [estimators]
    section = estimators if isinstance(estimators, dict) else {_name(one): {} for one in estimators}
    if not section:
        raise ValueError("estimators: there is none")
    return {_name(key): value for key, value in section.items()}


def _name(estimator):
    name = estimator if isinstance(estimator, str) else getattr(estimator, "seifbed_name", None)
    if name is None:
        raise TypeError(f"{estimator!r} is no estimator: give its name, or decorate its class with @seifbed.estimator")
    return name
