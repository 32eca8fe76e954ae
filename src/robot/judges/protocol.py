"""Holds lines of the vehicle protocol against docs/vehicle.schema.json: python3 protocol.py LINES, in the repository's root.

Each line of the file has what was written, by which side, and whether our reader takes it (tests/vehicle_schema.rs). What was
said as a whole is allowed; of what is spoilt the schema refuses exactly what is not read."""

import json
import sys
from collections import Counter
from pathlib import Path

try:
    from jsonschema import Draft202012Validator
except ImportError as missing:
    print(missing)
    sys.exit(77)

SCHEMA = json.loads(Path("docs/vehicle.schema.json").read_text())
Draft202012Validator.check_schema(SCHEMA)
VALIDATORS = {
    of: Draft202012Validator({"$schema": SCHEMA["$schema"], "$ref": f"#/$defs/{of}", "$defs": SCHEMA["$defs"]})
    for of in ("Order", "Message")
}

counts, apart = Counter(), []
for text in Path(sys.argv[1]).read_text().splitlines():
    told = json.loads(text)
    is_allowed = VALIDATORS[told["of"]].is_valid(told["line"])
    counts[told["of"], told["is_whole"], is_allowed] += 1
    if is_allowed != told["is_read"]:
        verdict = "allowed and not read" if is_allowed else "read and not allowed"
        apart.append(f"{verdict}: {json.dumps(told['line'], ensure_ascii=False)}")

assert not apart, "\n".join([f"{len(apart)} lines", *apart[:40]])
for of in VALIDATORS:
    assert counts[of, True, True] and counts[of, False, False] > 500, counts
    # A field that nobody knows is passed over.
    assert counts[of, False, True] > 20, counts
print(dict(counts))
