"""A polygon mesh put together by hand: points, faces and face labels."""

from collections import namedtuple

from . import vec

# Every face remembers the names it is written under in the OBJ file, and its
# corners' places in the picture (from 0 to 1, upwards) if it has one.
Label = namedtuple("Label", "object group material uv", defaults=(None,))


class Mesh:
    def __init__(self, name):
        self.points = []
        self.faces = []
        self.labels = []
        self.label = Label(name, None, None)
        self.lines = []        # marked edges, as rows of points
        self.picture = None    # what faces with material "painted" show

    # -- building ---------------------------------------------------------

    def point(self, position):
        self.points.append(tuple(float(c) for c in position))
        return len(self.points) - 1

    def ring(self, positions):
        return [self.point(p) for p in positions]

    def face(self, *corners):
        self.faces.append(tuple(corners))
        self.labels.append(self.label)

    def use(self, **names):
        """Change the object, group or material of the faces that follow."""
        self.label = self.label._replace(**names)

    def mark(self, row):
        """A seam along these points, where no change of group is one."""
        self.lines.append(tuple(row))

    def fan(self, loop, apex):
        """Triangles from a counter-clockwise loop to one apex."""
        for a, b in neighbours(loop):
            self.face(a, b, apex)

    def tube(self, lower, upper):
        """Quads between two equal loops.

        `lower` runs counter-clockwise seen from `upper`'s side, so the
        quads look outward.
        """
        assert len(lower) == len(upper)
        for (a, b), (c, d) in zip(neighbours(lower), neighbours(upper)):
            self.face(a, b, d, c)

    def strip(self, first, second):
        """Quads between two equal open rows of points."""
        assert len(first) == len(second)
        for j in range(len(first) - 1):
            self.face(first[j], first[j + 1], second[j + 1], second[j])

    def zip_rows(self, first, second):
        """Like strip, with triangles where the rows differ in length.

        Both rows are walked in step; the one that lags behind moves on.
        """
        i = j = 0
        m, n = len(first) - 1, len(second) - 1
        while i < m or j < n:
            ahead, behind = (i + 1) * n, (j + 1) * m
            if ahead == behind:
                self.face(first[i], first[i + 1], second[j + 1], second[j])
                i, j = i + 1, j + 1
            elif ahead < behind:
                self.face(first[i], first[i + 1], second[j])
                i += 1
            else:
                self.face(first[i], second[j + 1], second[j])
                j += 1

    # -- reshaping --------------------------------------------------------

    def open_hole(self, cells):
        """Remove the faces with these corner sets; return the rim.

        The rim runs the way the removed faces did, counter-clockwise seen
        from outside, and starts at the smallest point number.
        """
        wanted = {frozenset(cell) for cell in cells}
        gone = [f for f in self.faces if frozenset(f) in wanted]
        assert len(gone) == len(wanted), "no such face to open"
        keep = [k for k, f in enumerate(self.faces)
                if frozenset(f) not in wanted]
        self.faces, self.labels = ([self.faces[k] for k in keep],
                                   [self.labels[k] for k in keep])
        return rim_of(gone)

    def crease(self, a, b, c, d):
        """Fold the cell a, b, c, d along its diagonal from a to c."""
        self.open_hole([(a, b, c, d)])
        self.face(a, b, c)
        self.face(a, c, d)

    def paint_between(self, material, points):
        """Give a material to the faces with all corners among `points`."""
        self.labels = [
            label._replace(material=material) if points.issuperset(face)
            else label for face, label in zip(self.faces, self.labels)]

    def mirror_x(self, rename=None):
        """Add the mirror image at x = 0; points on the plane are shared.

        `rename` makes the name of the image's group from the original's.
        """
        twin = []
        for i, (x, y, z) in enumerate(list(self.points)):
            twin.append(i if x == 0.0 else self.point((-x, y, z)))
        for face, label in list(zip(self.faces, self.labels)):
            self.faces.append(tuple(twin[i] for i in reversed(face)))
            self.labels.append(label if rename is None else
                               label._replace(group=rename(label.group)))
        for line in list(self.lines):
            image = tuple(twin[i] for i in line)
            if image != line:
                self.lines.append(image)
        return twin

    def sort_groups(self, names):
        """Faces in the order of their groups, else as they were made."""
        order = sorted(range(len(self.faces)),
                       key=lambda k: names.index(self.labels[k].group))
        self.faces, self.labels = ([self.faces[k] for k in order],
                                   [self.labels[k] for k in order])

    def triangulate(self):
        """Split the quads along the diagonal with the better angles."""
        faces, labels = [], []
        for face, label in zip(self.faces, self.labels):
            for part in self.split(face):
                faces.append(part)
                labels.append(part_of(label, face, part))
        self.faces, self.labels = faces, labels

    def split(self, face):
        if len(face) == 3:
            return [face]
        if len(face) > 4:
            return self.clip_ears(face)
        a, b, c, d = face
        choices = [((a, b, c), (a, c, d)), ((a, b, d), (b, c, d))]
        return max(choices, key=lambda pair: min(
            self.smallest_angle(t) for t in pair))

    def clip_ears(self, face):
        """Triangles of a planar polygon that need not be convex."""
        normal = vec.polygon_normal([self.points[i] for i in face])
        rest, parts = list(face), []
        while len(rest) > 3:
            n = len(rest)
            ear = next(k for k in range(n) if self.is_ear(
                rest[k - 1], rest[k], rest[(k + 1) % n], rest, normal))
            parts.append((rest[ear - 1], rest[ear], rest[(ear + 1) % n]))
            del rest[ear]
        return parts + [tuple(rest)]

    def is_ear(self, a, b, c, polygon, normal):
        corners = [self.points[i] for i in (a, b, c)]
        if turn(*corners, normal) <= 0.0:
            return False
        return not any(
            all(turn(p, q, self.points[i], normal) >= 0.0
                for p, q in neighbours(corners))
            for i in polygon if i not in (a, b, c))

    def smallest_angle(self, face):
        p = [self.points[i] for i in face]
        n = len(p)
        return min(vec.angle_between(vec.sub(p[(i + 1) % n], p[i]),
                                     vec.sub(p[i - 1], p[i]))
                   for i in range(n))

    def move(self, change):
        self.points = [tuple(change(p)) for p in self.points]

    def round_points(self, digits):
        """The checks must judge the very numbers the file will hold."""
        self.points = [tuple(round(c, digits) + 0.0 for c in p)
                       for p in self.points]

    def drop_unused_points(self):
        used = sorted({i for face in self.faces for i in face})
        number = {old: new for new, old in enumerate(used)}
        self.points = [self.points[i] for i in used]
        self.faces = [tuple(number[i] for i in f) for f in self.faces]
        self.lines = [tuple(number[i] for i in r) for r in self.lines]


def part_of(label, face, part):
    """The label of some of a face's corners."""
    if label.uv is None:
        return label
    return label._replace(uv=tuple(label.uv[face.index(i)] for i in part))


def neighbours(loop):
    return [(loop[i], loop[(i + 1) % len(loop)]) for i in range(len(loop))]


def turn(a, b, c, normal):
    """Positive where a, b, c turn left seen against the normal."""
    return vec.dot(vec.cross(vec.sub(b, a), vec.sub(c, a)), normal)


def rim_of(faces):
    """The one outline of some connected faces, in their own direction."""
    halves = {half for face in faces for half in neighbours(face)}
    following = {a: b for a, b in halves if (b, a) not in halves}
    rim = [min(following)]
    while following[rim[-1]] != rim[0]:
        rim.append(following[rim[-1]])
    assert len(rim) == len(following), "the opened faces have several rims"
    return rim
