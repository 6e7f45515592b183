"""What a long run has behind it, one JSON record a line, so that it goes on where it stopped."""
import json


def read_records(path):
    """The records of a file, in order; none where there is no file."""
    for line in path.read_text(encoding="utf-8").splitlines() if path.exists() else []:
        try:
            yield json.loads(line)
        except ValueError:  # the last line of a run that was killed
            continue


def known_blocks(path):
    """The records of blocks of numbered cases by (first, count)."""
    return {(record["first"], record["count"]): record for record in read_records(path)}
