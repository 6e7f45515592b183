"""Netgen's volume mesh of a triangulated surface that it keeps: netgen_volume.py SURFACE.off VOLUME.mesh

Prints the CPU seconds of the volume mesher only. Needs Debian's python3-netgen, so run it by /usr/bin/python3.
"""
import sys
import time

from netgen.meshing import Element2D, FaceDescriptor, Mesh, MeshPoint, MeshingParameters, Pnt


def read_off(path):
    with open(path, encoding="ascii") as file:
        rows = [line.split("#")[0].split() for line in file]
    rows = [row for row in rows if row and row != ["OFF"]]
    vertices, faces = int(rows[0][0]), int(rows[0][1])
    points = [tuple(map(float, row[:3])) for row in rows[1:1 + vertices]]
    return points, [tuple(map(int, row[1:4])) for row in rows[1 + vertices:1 + vertices + faces]]


def main():
    points, triangles = read_off(sys.argv[1])
    mesh = Mesh(dim=3)
    numbers = [mesh.Add(MeshPoint(Pnt(*p))) for p in points]
    face = mesh.Add(FaceDescriptor(surfnr=1, domin=1, bc=1))
    for triangle in triangles:
        mesh.Add(Element2D(face, [numbers[i] for i in triangle]))
    started = time.process_time()
    mesh.GenerateVolumeMesh(MeshingParameters())
    print(time.process_time() - started)
    with open(sys.argv[2], "w", encoding="ascii") as out:
        out.write(f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(mesh.Points())}\n")
        for p in mesh.Points():
            out.write("%r %r %r 0\n" % tuple(p.p))
        elements = mesh.Elements3D()
        out.write(f"Tetrahedra\n{len(elements)}\n")
        for element in elements:
            a, b, c, d = (v.nr for v in element.vertices)
            out.write(f"{a} {c} {b} {d} 1\n")  # its tetrahedra have the other orientation
        out.write("End\n")


main()
