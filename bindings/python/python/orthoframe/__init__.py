"""An embedded knowledge base and logic engine for robots that work inside buildings.

    import orthoframe

    with orthoframe.open("ortho-store") as engine:
        engine.import_file("maps/rb2.toml")
        print(engine.ask("Where is the medicine?")["text"])
        for event in engine.run("Bring the medicine"):
            print(event)

Lengths are cm, angles degrees counter-clockwise from +x. What is answered are dicts, of the shapes of `ortho --json`
(docs/cli.md); what goes wrong is an `orthoframe.Error`, which knows the place of each fault. See docs/python.md.
"""

from ._native import Dialogue, Engine, Task
from .arrays import Array, Floor, Relation
from .errors import Error, Fault, InputError, MachineError
from .vehicle import Bumped, Refused, Stopped, Vehicle

open = Engine.open
in_memory = Engine.in_memory

__all__ = [
    "Array",
    "Bumped",
    "Dialogue",
    "Engine",
    "Error",
    "Fault",
    "Floor",
    "InputError",
    "MachineError",
    "Refused",
    "Relation",
    "Stopped",
    "Task",
    "Vehicle",
    "in_memory",
    "open",
]
