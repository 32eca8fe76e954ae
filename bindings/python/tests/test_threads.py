"""Eight threads at once: no deadlock, no panic, and every answer one that is true."""

import random
import threading
import time

import orthoframe
from conftest import Cart

THREADS, SECONDS = 8, 6.0


def test_eight_threads_ask_edit_and_drive(house):
    expected = {fact["args"][0] for fact in house.relations("ON_TOP_OF", of="Table 1")}
    faults, counts, over = [], [0] * THREADS, time.monotonic() + SECONDS

    def ask(n, dice):
        assert house.ask("Where is the medicine?")["text"]

    def relations(n, dice):
        facts = {fact["args"][0] for fact in house.relations("ON_TOP_OF", of="Table 1")}
        # The cup is moved by the others, and stays on the table.
        assert facts == expected, facts

    def arrays(n, dice):
        house.relation("ON_TOP_OF").tuples()
        house.floor().polygons()

    def edit(n, dice):
        house.edit({"edit": [{"move": "Cup 1", "by": [dice.choice([-1, 1]), 0]}]})
        if house.revision > 2:
            house.undo()

    def nonsense(n, dice):
        for call in (lambda: house.find("nothing"), lambda: house.edit("["), lambda: house.query("?-")):
            try:
                call()
            except orthoframe.InputError:
                continue
            raise AssertionError("nonsense was taken")

    def drive(n, dice):
        try:
            task = house.run(dice.choice(["Go to Room Y", "Go to Point A"]), dice.choice([None, Cart(*house_pose())]))
            if dice.random() < 0.3:
                task.cancel()
            for _event in task:
                pass
            task.result(30)
        except orthoframe.InputError as error:
            assert "under way" in str(error), error

    def house_pose():
        pose = house.where()["pose"]
        return pose["x"], pose["y"], pose["heading_deg"]

    def work(n):
        dice = random.Random(n)
        steps = [ask, relations, arrays, edit, nonsense, drive]
        try:
            while time.monotonic() < over:
                dice.choice(steps)(n, dice)
                counts[n] += 1
        except BaseException as error:  # noqa: BLE001
            faults.append(error)
            raise

    threads = [threading.Thread(target=work, args=(n,)) for n in range(THREADS)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(SECONDS + 90)
        assert not thread.is_alive(), "a thread hangs"
    assert not faults, faults
    assert min(counts) > 0, counts


def test_the_interpreter_is_let_go(house):
    """While one thread has the map derived anew, another counts."""
    counted, over = 0, threading.Event()

    def derive():
        try:
            for _ in range(3):
                house.edit({"edit": [{"move": "Table 1", "by": [1, 0], "carry": True}]})
                house.floor()
        finally:
            over.set()

    thread = threading.Thread(target=derive)
    thread.start()
    while not over.is_set():
        counted += 1
        time.sleep(0.0005)
    thread.join()
    assert counted > 20, counted


def test_the_robot_goes_from_hand_to_hand(house):
    """Who takes the robot as another lets it go keeps the store for the whole way."""
    faults, over = [], time.monotonic() + 3.0

    def send():
        while time.monotonic() < over:
            try:
                task = house.run("Go to Point A")
                task.cancel()
                task.result(30)
            except orthoframe.InputError as error:
                if "under way" not in str(error):
                    faults.append(error)

    def ask():
        while time.monotonic() < over:
            house.ask("Where is the medicine?")

    threads = [threading.Thread(target=work) for work in [send] * 8 + [ask] * 4]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(90)
        assert not thread.is_alive(), "a thread hangs"
    assert not faults, faults
