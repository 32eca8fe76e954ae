"""What the tests share: the flat of robot RB-2, and a cart that goes exactly where it is sent."""

import math
from pathlib import Path

import pytest

import orthoframe

ROOT = Path(__file__).resolve().parents[3]
FLAT = ROOT / "maps" / "rb2.toml"
MAP = "Квартира РБ-2"


class Cart(orthoframe.Vehicle):
    """Meets nothing, and its hand and doors never fail. It is in no time where it is sent."""

    name = "cart of the tests"

    def __init__(self, x=120.0, y=85.0, heading=90.0):
        self.at = (MAP, x, y, heading)
        self.clock = 0.0
        self.done = []

    def pose(self):
        return self.at

    def time(self):
        return self.clock

    def follow(self, path, heading, speed):
        self.done.append("follow")
        for x, y in path:
            _, x0, y0, facing = self.at
            if math.hypot(x - x0, y - y0) > 1e-6:
                facing = math.degrees(math.atan2(y - y0, x - x0))
            self.at = (MAP, x, y, facing)
            self.clock += 1.0
            self.going()
        if heading is not None:
            self.at = (*self.at[:3], heading)

    def obey(self, *args, **named):
        self.done.append(named)
        self.clock += 1.0

    set_door = call_lift = take = put = hand_over = take_back = switch = call = look_round = obey


@pytest.fixture
def flat():
    return orthoframe.in_memory(FLAT)


@pytest.fixture
def house(tmp_path):
    with orthoframe.open(tmp_path / "store") as engine:
        engine.import_file(FLAT)
        yield engine
