"""Blocks of numbered cases that a long run has behind it, one JSON record a line, so that it goes on where it stopped."""
import json


def known_blocks(path):
    """The records of a file by (first, count); none where there is no file."""
    known = {}
    for line in path.read_text(encoding="utf-8").splitlines() if path.exists() else []:
        try:
            record = json.loads(line)
        except ValueError:  # the last line of a run that was killed
            continue
        known[record["first"], record["count"]] = record
    return known
