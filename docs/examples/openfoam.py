# After faceAgglomerate, in place of viewFactorsGen:
#   python3 openfoam.py constant[/REGION] [options of shaftcull factors]
import re
import subprocess
import sys

import numpy
from scipy import sparse

folder = sys.argv[1]


def read(name):
    """The lists in a file: 3(0 1 2), or 3{0} for 3(0 0 0)."""
    with open(f"{folder}/{name}") as file:
        lists = re.findall(r"(\d*)\s*(?:\(([^(){}]*)\)|\{(\d+)\})", file.read())
    return [items.split() or [item] * int(size) for size, items, item in lists]


def text(items):
    return f"{len(items)}({' '.join(map(str, items))})\n"


def write(name, kind, *values):
    with open(f"{folder}/{name}", "w") as file:
        file.write(f"FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n")
        file.writelines(values)


# The faces of each coarse face. Coarse faces are in the order of their first faces.
coarse_faces = []
faces = read("polyMesh/faces")
with open(f"{folder}/polyMesh/boundary") as file:
    patches = re.findall(r"\{([^{}]*nFaces[^{}]*)\}", file.read())
for patch, clusters in zip(patches, read("finalAgglom"), strict=True):
    if "viewFactorWall" in patch:
        start = int(re.search(r"startFace\s+(\d+)", patch)[1])
        found = {}
        for face, cluster in zip(faces[start:], clusters):
            found.setdefault(cluster, []).append(face)
        coarse_faces += found.values()

# An object per coarse face. Faces of a mesh face outwards, and these face into the room.
with open("walls.obj", "w") as file:
    for point in read("polyMesh/points"):
        file.write(f"v {' '.join(point)}\n")
    for i, members in enumerate(coarse_faces):
        file.write(f"o {i}\n")
        for face in members:
            file.write(f"f {' '.join(str(int(point) + 1) for point in reversed(face))}\n")
program = ["shaftcull", "factors", "walls.obj", "--out", "walls.npz", *sys.argv[2:]]
subprocess.run(program, check=True)

# From patches to coarse faces: exchanges add up.
more = numpy.load("walls.npz")
owner, area = more["patch_objects"], more["area"]
join = sparse.csr_matrix((numpy.ones(len(owner)), (owner, numpy.arange(len(owner)))))
exchange = join @ sparse.diags(area) @ sparse.load_npz("walls.npz") @ join.T
factors = sparse.csr_matrix(sparse.diags(1 / (join @ area)) @ exchange)


def rows_of(values):
    return text([text(row) for row in numpy.split(values, factors.indptr[1:-1])])


write("F", "scalarListList", rows_of(factors.data))
write("globalFaceFaces", "labelListList", rows_of(factors.indices))
all_faces = f"1({text(range(len(coarse_faces)))})\n"
write("mapDist", "mapDistribute", f"{len(coarse_faces)}\n", all_faces, all_faces, "0 0 0() 0()\n")
