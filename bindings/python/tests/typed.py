"""A program as an editor's type checker sees it."""

import orthoframe


class Robot(orthoframe.Vehicle):
    name = "robot"

    def pose(self) -> tuple[str, float, float, float]:
        return ("map", 0.0, 0.0, 0.0)

    def follow(self, path: list[tuple[float, float]], heading: float | None, speed: float | None) -> None:
        self.going()


def main() -> None:
    with orthoframe.open("store", language="en") as engine:
        text: str = engine.ask("Where is the cup?")["text"]
        rows: list[tuple[object, ...]] = list(engine.relation("ON_TOP_OF").tuples())
        task = engine.run(text, Robot())
        for event in task:
            print(event["event"], rows)
        try:
            task.result(1.0)
        except orthoframe.InputError as error:
            print(error.file, error.line, error.column)
