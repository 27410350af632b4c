"""A robot of many closed parts, each an object of its own.

Every part is a stack of eight-cornered rings, rectangles with their corners
cut at 45 degrees; faces between such rings are planar.  The parts stand a
millimetre or two apart, so that each can be built alone.
"""

from .mesh import Mesh

# One ring of a stack: its height, half width, half depth and corner cut.
BODY = [(8.6, 2.6, 1.8, 0.8), (9.6, 4.0, 2.8, 1.0), (15.6, 5.0, 3.4, 1.2),
        (17.0, 3.6, 2.4, 1.0)]
BELT = [(7.2, 2.6, 1.8, 0.8), (8.4, 2.6, 1.8, 0.8)]
NECK = [(17.2, 1.6, 1.6, 0.6), (18.2, 1.6, 1.6, 0.6)]
HEAD = [(18.4, 3.2, 2.6, 0.9), (19.4, 4.2, 3.4, 1.2), (23.8, 4.2, 3.4, 1.2),
        (25.2, 2.8, 2.2, 0.9)]
ANTENNA = [(25.4, 0.9, 0.9, 0.35), (26.2, 0.6, 0.6, 0.25),
           (27.8, 0.6, 0.6, 0.25), (28.6, 1.3, 1.3, 0.55),
           (29.8, 1.3, 1.3, 0.55), (30.6, 0.6, 0.6, 0.25)]
EYE = [(3.5, 1.1, 1.1, 0.45), (4.0, 1.1, 1.1, 0.45), (4.5, 0.6, 0.6, 0.25)]
MOUTH = [(3.5, 1.9, 0.55, 0.25), (3.9, 1.9, 0.55, 0.25)]
EAR = [(4.4, 1.4, 1.4, 0.6), (5.2, 1.4, 1.4, 0.6), (5.8, 0.7, 0.7, 0.3)]
BADGE = [(3.5, 1.2, 1.2, 0.5), (4.1, 1.2, 1.2, 0.5)]
SHOULDER = [(5.2, 1.5, 1.5, 0.6), (7.6, 1.5, 1.5, 0.6), (8.2, 0.8, 0.8, 0.3)]
ARM = [(6.4, 0.9, 0.9, 0.35), (9.6, 1.3, 1.3, 0.5), (13.4, 1.0, 1.0, 0.4)]
HAND = [(3.6, 0.8, 0.6, 0.25), (4.6, 1.4, 1.0, 0.4), (6.2, 1.1, 1.0, 0.4)]
LEG = [(2.4, 1.3, 1.4, 0.5), (4.6, 1.1, 1.1, 0.4), (7.0, 1.1, 1.1, 0.4)]
FOOT = [(0.0, 1.9, 2.8, 0.8), (1.2, 1.9, 2.8, 0.8), (2.2, 1.3, 1.6, 0.5)]


def build():
    robot = Mesh("robot")
    robot.use(group="torso")
    stack(robot, "body", "enamel", BODY, upright())
    stack(robot, "belt", "slate", BELT, upright())
    stack(robot, "badge", "lamp", BADGE, forward(0, 13.0))
    robot.use(group="head")
    stack(robot, "neck", "slate", NECK, upright())
    stack(robot, "head", "steel", HEAD, upright())
    stack(robot, "antenna", "lamp", ANTENNA, upright())
    stack(robot, "mouth", "slate", MOUTH, forward(0, 20.2))
    for name, side in (("left", 1.0), ("right", -1.0)):
        robot.use(group="head")
        stack(robot, "eye-" + name, "lamp", EYE, forward(side * 1.8, 22.4))
        stack(robot, "ear-" + name, "enamel", EAR, sideways(side, 21.6))
        robot.use(group="limbs")
        stack(robot, "shoulder-" + name, "slate", SHOULDER,
              sideways(side, 15.2))
        stack(robot, "arm-" + name, "steel", ARM, upright(side * 6.6))
        stack(robot, "hand-" + name, "enamel", HAND, upright(side * 6.6, 0.0))
        stack(robot, "leg-" + name, "steel", LEG, upright(side * 2.2))
        stack(robot, "foot-" + name, "enamel", FOOT, upright(side * 2.2, 0.8))
    return robot


# -- which way a stack grows ------------------------------------------------
# Each of these maps (across, height, depth) without mirroring.

def upright(x=0.0, z=0.0):
    return lambda a, h, d: (x + a, h, z + d)


def forward(x, y):
    return lambda a, h, d: (x + a, y - d, h)


def sideways(side, y):
    return lambda a, h, d: (side * h, y - side * a, d)


def stack(robot, name, material, rings, place):
    robot.use(object=name, material=material)
    loops = [robot.ring([place(a, height, d)
                         for a, d in cut_rectangle(w, depth, cut)])
             for height, w, depth, cut in rings]
    robot.face(*reversed(loops[0]))
    for lower, upper in zip(loops, loops[1:]):
        robot.tube(lower, upper)
    robot.face(*loops[-1])


def cut_rectangle(w, d, cut):
    """Counter-clockwise seen from above, where depth points down the page."""
    return [(w, d - cut), (w, cut - d), (w - cut, -d), (cut - w, -d),
            (-w, cut - d), (-w, d - cut), (cut - w, d), (w - cut, d)]
