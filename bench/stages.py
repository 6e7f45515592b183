"""Where the time of `holdfast mesh` goes, by stage, from its reports."""
from statistics import median

ORDER = ["read", "validate", "delaunay", "flips", "partition", "classify", "suppress", "optimise", "write"]


def medians(reports):
    """stage -> median of its seconds."""
    return {stage: median(r["seconds"].get(stage, 0) for r in reports) for stage in reports[0]["seconds"]}


def table(first, profiles):
    """Per cent of the whole; `profiles` maps entries of the column `first` to the seconds of the stages."""
    shown = [s for s in ORDER if any(s in seconds for seconds in profiles.values())]
    lines = [f"| {first} | seconds | " + " | ".join(f"{s} %" for s in shown) + " |", "|---" + "|---:" * (len(shown) + 1) + "|"]
    for name, seconds in profiles.items():
        shares = (100 * seconds.get(stage, 0) / seconds["total"] for stage in shown)
        lines.append(f"| {name} | {seconds['total']:.2f} | " + " | ".join(f"{share:.1f}" for share in shares) + " |")
    return lines
