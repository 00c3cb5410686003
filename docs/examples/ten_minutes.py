# The first ten minutes with shaftcull, from Python: the snippets of docs/ten-minutes.md.
import numpy as np
import shaftcull as sc

# [[first cull]]
lamp = [0, 9, 0, 1, 10, 1]
table = [4, 0, 4, 6, 1, 6]
scene = np.array([[2, 4, 2, 3, 5, 3], [8, 0, 0, 9, 3, 1], [4, -1, 4, 6, 0, 6]], np.float32)

boxes = sc.BoxStream(scene)  # checked, aligned, one stream per coordinate
shaft = sc.Shafts.between(lamp, table)
for i, kept in enumerate(boxes.cull(shaft)):  # element i: box i may stand between
    print(f"box {i} {'may' if kept else 'cannot'}")
# [[end]]

# [[many shafts]]
ends = np.array([lamp, table, [9, 9, 9, 9, 9, 9]], np.float32)
shafts = sc.Shafts.between(ends, ends, pairs=[[0, 1], [0, 2], [1, 2]])
lists = boxes.list(shafts)  # in parallel; shaft s keeps the boxes of lists[s]
for s, kept in enumerate(lists):
    print(f"shaft {s} keeps {len(kept)}")
# [[end]]

# [[tree]]
tree = sc.BoxTree(scene)  # sorted once; takes the same queries
lists = tree.list(shafts, exclude=2)  # box 2 is left out
print(f"{len(lists[0])} without box 2, {'some' if tree.any(shafts[0]) else 'none'} with it")
# [[end]]

# [[frames]]
for frame in range(3):
    scene += np.float32([0.5, 0, 0, 0.5, 0, 0])
    tree.update(scene)  # nothing is sorted
    now = sc.Shafts.between(lamp, table)  # form shafts again: it takes microseconds
    print(f"frame {frame}: {tree.count(now)}")
if tree.sah_ratio() > 2:  # when much has moved far
    tree.rebuild()
# [[end]]

# [[kinds]]
sweep = sc.Shafts.swept([3, 8, 2, 4, 9, 3], [0, -6, 0])  # a crate falls
sunlit = sc.Shafts.swept_infinite(table, [-1, 2, -1])
hidden = sc.Shafts.shadow(lamp, scene[0])
hull = sc.ConvexHull([[0, 0, 0], [4, 0, 0], [0, 9, 0], [5, 5, 5]])
print(tree.count(sweep), tree.count(sunlit), tree.count(hidden), tree.count(hull))

index, time = tree.first_contact(sweep)
if index >= 0:
    print(f"first box {index}, after {time:.2f} of the way")
# [[end]]

# [[contact]]
floor = sc.BoxStream([[-9, -1, -9, 9, 0, 9]])  # the table stands on it
print(f"closed: {floor.any(shaft):d}, open: {floor.any(shaft.with_contact('open')):d}")
# [[end]]

# [[occluded]]
walls = sc.BoxStream([[-9, 5, -9, 9, 6, 9]])  # solid: it fills its box
print("the lamp does not light the table" if walls.occluded(shaft) else "it may")
# [[end]]

# [[errors]]
try:
    scene[1, 0] = 99  # beyond hi
    boxes.update(scene)
except sc.BadBound as error:
    print(error)
# [[end]]
