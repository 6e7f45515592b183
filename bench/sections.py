"""A document whose sections are written separately: each run replaces one and does not change the others."""


def sections_of(path, headings):
    """heading -> its lines, without blank ones at its ends; text before all of `headings` has the heading None."""
    found, heading = {None: []}, None
    for line in path.read_text(encoding="utf-8").splitlines() if path.exists() else []:
        if line in headings:
            heading = line
            found[heading] = []
        else:
            found[heading].append(line)
    return {heading: "\n".join(lines).strip("\n") for heading, lines in found.items()}


def replace(path, headings, heading, lines):
    """Replaces a section by `lines`, which include the heading; `headings` gives the order."""
    text = sections_of(path, headings)
    text[heading] = "\n".join(line for line in lines if line != heading).strip("\n")
    parts = [f"{h}\n\n{text[h]}" if h else text[h] for h in (None, *headings) if text.get(h)]
    path.write_text("\n\n".join(parts) + "\n", encoding="utf-8")
