"""Plans before the validator of unified-planning: domain, problem and plan by threes; 77 where it is not there.

It knows no parallel steps, so each plan is carried out as written, one action after the other.
"""

import sys

try:
    from unified_planning.engines import SequentialPlanValidator
    from unified_planning.io import PDDLReader
except ImportError:
    sys.exit(77)



def actions(path):
    for line in open(path, encoding="utf-8"):
        line = line.split(";")[0].strip()
        if ":" in line:
            yield line.split(":", 1)[1].strip()


failed = False
files = sys.argv[1:]
for domain, problem, plan in zip(files[::3], files[1::3], files[2::3]):
    reader = PDDLReader()
    read = reader.parse_problem(domain, problem)
    parsed = reader.parse_plan_string(read, "\n".join(actions(plan)))
    verdict = SequentialPlanValidator().validate(read, parsed)
    print(f"{plan}: {'valid' if verdict else 'INVALID'}")
    failed |= not verdict
sys.exit(1 if failed else 0)
