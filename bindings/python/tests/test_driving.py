"""Tasks: told as they happen, driven by a vehicle in Python, stopped from elsewhere."""

import threading
import time

import pytest

import orthoframe
from conftest import MAP, Cart


def test_a_task_tells_what_happens(house):
    task = house.run("Bring the medicine", poses=True)
    events = list(task)
    kinds = [event["event"] for event in events]
    assert kinds[0] == "planned" and kinds[-1] == "replied" and "arrived" in kinds and "moved" in kinds
    result = task.result()
    assert result["outcome"] == "done" and task.done
    assert result["replies"][0]["directives"]
    # The robot stands where it says, and the store knows.
    assert house.where()["pose"] == pytest.approx(result["replies"][0]["end"])


def test_a_vehicle_in_python_drives(house):
    cart = Cart()
    result = house.run("Bring the medicine", cart).result(60)
    assert result["outcome"] == "done", result
    assert cart.done.count("follow") > 2 and {"thing": "Лекарство"} in cart.done
    end = result["replies"][0]["end"]
    assert (end["x"], end["y"]) == pytest.approx(cart.at[1:3], abs=0.01)
    # And once more.
    assert house.run("Go to Point A", cart).result(60)["outcome"] in ("done", "already_true")


def test_a_cart_that_meets_something_looks_for_another_way(house):
    class Blocked(Cart):
        def __init__(self):
            super().__init__()
            self.bumps = 0

        def follow(self, path, heading, speed):
            if self.bumps == 0:
                self.bumps += 1
                raise orthoframe.Bumped("unknown")
            super().follow(path, heading, speed)

    cart = Blocked()
    task = house.run("Go to Room Y", cart)
    kinds = [event["event"] for event in task]
    assert cart.bumps == 1 and "surprised" in kinds
    assert task.result(60)["outcome"] in ("done", "stuck")


def test_a_cart_refuses(house):
    class Weak(Cart):
        def take(self, thing):
            raise orthoframe.Refused({"out_of_reach": {"thing": thing}})

    task = house.run("Bring the medicine", Weak())
    assert any(event["event"] == "surprised" for event in task)
    assert task.result(60)["outcome"] != "done"


@pytest.mark.parametrize("fault", ["raises", "lies", "no_method", "no_pose", "nan", "off_the_map"])
def test_a_faulty_vehicle_ends_the_mission_and_says_why(house, fault, capfd):
    class Faulty(Cart):
        def follow(self, path, heading, speed):
            if fault == "raises":
                raise OSError("the motor is off")
            if fault == "lies":
                self.at = (MAP, 9999.0, 9999.0, 0.0)
            if fault == "nan":
                self.at = (MAP, float("nan"), 0.0, 0.0)
            if fault == "no_pose":
                del self.at

    cart = Faulty()
    if fault == "no_method":
        cart = type("Bare", (orthoframe.Vehicle,), {"pose": lambda self: (MAP, 120.0, 85.0, 90.0)})()
    if fault == "off_the_map":
        cart.at = ("Another map", 0.0, 0.0, 0.0)
    task = house.run("Go to Room Y", cart)
    try:
        result = task.result(60)
        assert result["outcome"] == "vehicle_failed"
        told = result["text"] + str(result["replies"][0].get("explanation_en"))
    except orthoframe.MachineError as error:
        told = str(error)
    expected = {"raises": "the motor is off", "no_method": "follow", "no_pose": "AttributeError", "off_the_map": "Another map"}
    assert expected.get(fault, "") in told
    # The next one drives.
    house.reset_robot()
    assert house.run("Go to Room Y", Cart()).result(60)["outcome"] == "done"


def test_what_is_no_vehicle_is_refused(house):
    with pytest.raises(TypeError):
        house.run("Go to Room Y", 3)
    with pytest.raises(orthoframe.InputError):
        house.run("Go to Room Y", "carrier pigeon")
    with pytest.raises(orthoframe.Error):
        house.run("Go to Room Y", "tcp:127.0.0.1:1").result(30)
    assert house.run("Go to Room Y").result(60)["outcome"] == "done"


class Slow(Cart):
    """Takes for ever, and says so."""

    def __init__(self):
        super().__init__()
        self.begun = threading.Event()

    def follow(self, path, heading, speed):
        while True:
            self.begun.set()
            time.sleep(0.01)
            self.clock += 0.01
            self.going()


def test_a_task_is_cancelled_from_another_thread(house):
    cart = Slow()
    task = house.run("Go to Room Y", cart)
    assert cart.begun.wait(30)
    with pytest.raises(TimeoutError):
        task.result(0.05)
    # While it drives it can be asked, and nothing else sends it.
    assert house.ask("Where is the medicine?")["outcome"] == "found"
    with pytest.raises(orthoframe.InputError, match="under way"):
        house.run("Go to Point A")
    with pytest.raises(orthoframe.InputError, match="under way"):
        house.dialogue().hear("Go to Point A")
    begun = time.monotonic()
    threading.Timer(0.1, task.cancel).start()
    result = task.result(10)
    assert result["outcome"] == "stopped" and time.monotonic() - begun < 5
    assert house.where()["pose"]["x"] == pytest.approx(120.0)
    assert house.run("Go to Room Y", Cart()).result(60)["outcome"] == "done"


def test_a_vehicle_that_keeps_silent_is_given_up(house):
    class Silent(Cart):
        def follow(self, path, heading, speed):
            time.sleep(4)

    begun = time.monotonic()
    result = house.run("Go to Room Y", Silent(), silence=0.3).result(30)
    assert result["outcome"] == "vehicle_failed" and time.monotonic() - begun < 3


def test_a_task_that_nobody_holds_is_done_all_the_same(house):
    house.run("Go to Room Y")
    for _ in range(200):
        if house.where()["area"] == "Комната-Y":
            return
        time.sleep(0.05)
    pytest.fail("it never arrived")
