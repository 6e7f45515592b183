"""Elements on tessellated CAD parts, which are full of needles: Holdfast beside TetGen on a fixed sample of the corpus.

    cad.py --build build/release --corpus DIR [--modes fill,fast,good,best] [--only NAME]

DIR holds the valid surfaces of the corpus as .off. Tells, for each surface and mesher, the tetrahedra, the shares with an angle below
10, 20 and 30 degrees by number and by volume, the least angle, the mean Q and the seconds of CPU with files read and written;
then the means, and on how many surfaces Holdfast's shares are no larger than TetGen's (`tetgen -pYq1.4`).
"""
import argparse
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

import process

SAMPLE = """
kicad_Connector_PinSocket_1.00mm_PinSocket_1x32_P1.00mm_Vertical_SMD_Pin1Right_d0.002_fuse
kicad_Package_QFP_LQFP-64_10x10mm_P0.5mm_d0.03_fuse
kicad_Package_BGA_BGA-624_21.0x21.0mm_Layout25x25_P0.8mm_d0.02_fuse
kicad_Package_BGA_UFBGA-132_7x7mm_Layout12x12_P0.5mm_d0.002_fuse
kicad_Package_SO_TSSOP-16_4.4x5mm_P0.65mm_d0.002_fuse
kicad_Package_DIP_DIP-24_W15.24mm_d0.01_fuse
kicad_Capacitor_SMD_CP_Elec_8x6.5_d0.002_fuse
kicad_TerminalBlock_Phoenix_TerminalBlock_Phoenix_MPT-0_5-11-2.54_1x11_P2.54mm_Horizontal_d0.002_fuse
kicad_Crystal_Crystal_SMD_0603-2Pin_6.0x3.5mm_d0.002_fuse
kicad_Connector_Dsub_DSUB-9_Male_Horizontal_P2.77x2.54mm_EdgePinOffset9.40mm_d0.03_fuse
kicad_Converter_DCDC_Converter_DCDC_RECOM_R-78HB-0.5_THT_d0.001_fuse
kicad_Connector_PinHeader_2.54mm_PinHeader_2x19_P2.54mm_Vertical_d0.002_fuse
prusa_extruder-idler_d0.001_fuse
prusa_y-motor-holder
mendel_x_idler_bracket-7
stepcode_HEAD_FRONT_d0.001_fuse
""".split()


def holdfast(options, surface, mode):
    words = ["--fill"] if mode == "fill" else ["--quality", mode]
    done = process.run([options.build / "holdfast", "mesh", surface, "-o", "out.mesh", "-q", "--threads", "1", *words],
                       options.timeout, options.folder)
    return done, options.folder / "out.mesh"


def tetgen(options, surface):
    (options.folder / "s.off").write_bytes(surface.read_bytes())
    return process.run(["tetgen", "-pYq1.4", "s.off"], options.timeout, options.folder), options.folder / "s.1.ele"


def measure(options, surface, mesher):
    """One row, or None where there is no mesh."""
    done, volume = tetgen(options, surface) if mesher == "tetgen" else holdfast(options, surface, mesher)
    if done.code != 0 or not volume.exists():
        return None
    shape = subprocess.run([options.build / "mesh_shape", volume], check=True, stdout=subprocess.PIPE, text=True).stdout
    volume.unlink()
    return json.loads(shape) | {"cpu": done.cpu}


def text_of(row):
    shares = [" / ".join(f"{row[key][k]:.3g}" for k in range(3)) for key in ("below", "volume_below")]
    return (f"{row['tetrahedra']:.0f} tetrahedra; {shares[0]} % below 10 / 20 / 30 degrees, {shares[1]} % by volume; "
            f"least {row['min_dihedral']:.3g}; mean Q {row['mean_q']:.3g}; {row['cpu']:.2f} s")


def summary(mesher, rows, peers):
    """Means, and how often the shares are no larger than those of the other on the same surface."""
    mean = {key: statistics.mean(r[key] for r in rows) for key in ("tetrahedra", "min_dihedral", "mean_q", "cpu")}
    for key in ("below", "volume_below"):
        mean[key] = [statistics.mean(r[key][k] for r in rows) for k in range(3)]
    print(f"{mesher}, mean of {len(rows)}: {text_of(mean)}")
    pairs = [(r, p) for r, p in zip(rows, peers) if p is not None]
    if not pairs or mesher == "tetgen":
        return
    wins = [sum(r["below"][k] <= p["below"][k] for r, p in pairs) for k in range(3)]
    least = sum(r["min_dihedral"] >= p["min_dihedral"] for r, p in pairs)
    number = statistics.median(r["tetrahedra"] / p["tetrahedra"] for r, p in pairs)
    cpu = statistics.median(r["cpu"] / p["cpu"] for r, p in pairs)
    print(f"  beside TetGen: shares no larger on {wins[0]}, {wins[1]}, {wins[2]} of {len(pairs)}, least angle no smaller on "
          f"{least}; {number:.2f} times as many tetrahedra and {cpu:.2f} of the time (medians)")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=lambda p: Path(p).resolve(), required=True)
    parser.add_argument("--corpus", type=lambda p: Path(p).resolve(), required=True)
    parser.add_argument("--modes", default="fill,fast,good")
    parser.add_argument("--only", default="")
    parser.add_argument("--timeout", type=float, default=600)
    options = parser.parse_args()
    meshers = ["tetgen", *options.modes.split(",")]
    table = {mesher: [] for mesher in meshers}
    with tempfile.TemporaryDirectory() as folder:
        options.folder = Path(folder)
        for name in SAMPLE:
            if options.only not in name:
                continue
            print(name)
            for mesher in meshers:
                row = measure(options, options.corpus / f"{name}.off", mesher)
                table[mesher].append(row)
                print(f"  {mesher}: {text_of(row) if row else 'no mesh'}", flush=True)
    for mesher in meshers:
        if all(table[mesher]) and table[mesher]:
            summary(mesher, table[mesher], table["tetgen"])


if __name__ == "__main__":
    main()
