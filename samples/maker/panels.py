"""What a garment promises beyond its surface: panels, and two equal halves."""

from .mesh import neighbours


def panel_problems(mesh, count):
    """Seams cut the mesh into `count` panels, each of them a disk."""
    panels = cut_apart(mesh)
    if len(panels) != count:
        yield "%d panels, not %d" % (len(panels), count)
    for name, characteristic in panels:
        # The pieces are connected and have a border: only a disk has 1.
        if characteristic != 1:
            yield "panel %s is not a disk" % name


def cut_apart(mesh):
    """Group and Euler characteristic of each panel, by their first faces."""
    marked = {frozenset(pair) for line in mesh.lines
              for pair in zip(line, line[1:])}
    side = {half: k for k, face in enumerate(mesh.faces)
            for half in neighbours(face)}
    faces, corners, joints = Sets(), Sets(), []
    for (a, b), k in side.items():
        other = side.get((b, a))
        if (other is None or frozenset((a, b)) in marked
                or mesh.labels[k].group != mesh.labels[other].group):
            continue
        faces.join(k, other)
        corners.join((k, a), (other, a))
        corners.join((k, b), (other, b))
        if a < b:
            joints.append(k)
    number = {}
    for k in range(len(mesh.faces)):
        number.setdefault(faces.find(k), len(number))
    panels = [[mesh.labels[k].group, 0] for k in number]
    for k, face in enumerate(mesh.faces):
        # A face less its sides; sides that meet are one: added below.
        panels[number[faces.find(k)]][1] += 1 - len(face)
    for k in joints:
        panels[number[faces.find(k)]][1] += 1
    for k, a in {corners.find((k, a)) for k, face in enumerate(mesh.faces)
                 for a in face}:
        panels[number[faces.find(k)]][1] += 1
    return panels


class Sets:
    """Which things are one, as they are joined."""

    def __init__(self):
        self.leader = {}

    def find(self, thing):
        root = thing
        while self.leader.get(root, root) != root:
            root = self.leader[root]
        while thing != root:
            self.leader[thing], thing = root, self.leader[thing]
        return root

    def join(self, one, other):
        # The lower one leads, so that a panel is known by its first face.
        low, high = sorted((self.find(one), self.find(other)))
        if low != high:
            self.leader[high] = low


def mirror_problems(mesh):
    """The mesh is its own mirror image at x = 0; left and right change."""
    place = {p: i for i, p in enumerate(mesh.points)}
    twin = [place.get((-x + 0.0, y, z)) for x, y, z in mesh.points]
    if None in twin:
        yield "a point has no mirror image"
        return

    def known(corners, group):
        first = corners.index(min(corners))
        return tuple(corners[first:] + corners[:first]), group

    faces = {known(list(f), l.group) for f, l in zip(mesh.faces, mesh.labels)}
    for face, label in zip(mesh.faces, mesh.labels):
        image = [twin[i] for i in reversed(face)]
        if known(image, other_side(label.group)) not in faces:
            yield "a face has no mirror image"
            return


def other_side(name):
    if name is None:
        return None
    here, there = (("left", "right") if "left" in name else ("right", "left"))
    return name.replace(here, there)
