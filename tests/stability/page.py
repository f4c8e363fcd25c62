"""docs/stability.md from what the stability suite found."""

HEAD = """# Hard cases

`make stability` writes this page: tests/stability runs {count} hard cases, in the combinations of modules that the rows name, and holds each to bounds and to an accuracy, against an analytic solution or a finer run. {distinct} of them differ by more than units: two runs of which one follows from the other by other units of mass, length, time or, where all is linear, load are counted once (tests/stability/distinct.py). Rows of a fixed time change one property and nothing else, as a user would. {failed}

## Known limits

Default schemes do not hold here; the suite expects it, and fails where one comes to hold unnoticed. The last column says whether the run stops (exit 1), warns, or ends without a word.

{limits}

## Schemes for comparison

The published scheme and its parts, on the same cases: all are expected to fail, with the symptom measured.

{comparison}

## Refused

What the program cannot take, it refuses before it writes anything.

{refused}
"""

GROUP = """## {name}

A row a case: the number of combinations, and of each bound and each error the worst among them, with its limit.

{table}
"""


def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(cell(entry) for entry in row) + " |" for row in rows])


def symptoms(found):
    return table(("case", "modules", "why", "symptom"),
                 [(one.case.name, one.case.modules, one.case.known, one.symptom) for one in found])


def worst(figures):
    """Of the figures of one name the largest."""
    names = dict.fromkeys(figure.name for figure in figures)
    most = [max((f for f in figures if f.name == name), key=lambda f: f.value) for name in names]
    return ", ".join(f"{f.name} {f.value:.1e} (≤ {f.limit:g})" for f in most)


def walked(found):
    rows, cases = [], {}
    for one in found:
        cases.setdefault(one.case.name, []).append(one)
    for name, ones in cases.items():
        modules = "; ".join(dict.fromkeys(one.case.modules for one in ones))
        rows.append((name, len(ones), modules, worst([f for one in ones for f in one.bounds]),
                     worst([f for one in ones for f in one.accuracy])))
    return table(("case", "runs", "modules", "bounds", "errors"), rows)


def page(found, distinct):
    wrong = [one for one in found if not one.as_expected]
    failed = "All did what is expected of them." if not wrong else \
        f"{len(wrong)} did not do what is expected: " + "; ".join(
            f"{one.case.name}, {one.case.modules} ({one.symptom or 'holds'})" for one in wrong) + "."
    limits = [one for one in found if one.case.known and one.case.ours]
    comparison = [one for one in found if one.case.known and not one.case.ours]
    refused = [one for one in found if one.case.refused]
    text = HEAD.format(count=len(found), distinct=distinct, failed=failed, limits=symptoms(limits),
                       comparison=symptoms(comparison),
                       refused=table(("case", "modules", "what it is told"),
                                     [(one.case.name, one.case.modules, one.complaint) for one in refused]))
    plain = [one for one in found if not one.case.known and not one.case.refused]
    order = dict.fromkeys(one.case.group for one in found)
    for group in order:
        ones = [one for one in plain if one.case.group == group]
        text += "\n" + GROUP.format(name=group, table=walked(ones))
    return text
