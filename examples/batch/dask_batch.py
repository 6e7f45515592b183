"""Meshes many parts on a Dask cluster: here two local workers; `Client("tcp://scheduler:8786")` takes one that runs.

    dask_batch.py OUTPUT FILE...
"""
import sys

from distributed import Client, LocalCluster

import holdfast


def main() -> int:
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        rows = holdfast.batch(sys.argv[2:], sys.argv[1], executor=client, time_limit=600, resume=True)
    for row in rows:
        print(row["status"], row["file"], row["message"])
    return 0 if all(row["status"] in ("done", "skipped") for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
