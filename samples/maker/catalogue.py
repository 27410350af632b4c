"""The list of all sample models with the promise each must keep."""

from collections import namedtuple

from . import (balloon, bird, blouse, doll, egg, flatbar, fox, hat, house,
               lampshade, lighthouse, mask, plates, plush, polyhedra, robot,
               skirt, sleeve, tshirt, tubes, whale)
from .check import Promise

# `digits` counts the decimals of the file's centimetres.
Model = namedtuple("Model", "name title build digits promise")

ANIMAL = dict(edge=0.02, angle=10.0, clearance=0.05)
SOLID = dict(edge=0.02, angle=20.0, clearance=0.05)
GARMENT = dict(edge=0.005, angle=15.0, clearance=0.05, mirrored=True)

MODELS = [
    Model("fox", "sitting fox", fox.build, 3,
          Promise(faces=(250, 500), **ANIMAL)),
    Model("whale", "humpback whale", whale.build, 3,
          Promise(faces=(150, 600), **ANIMAL)),
    Model("bird", "toucan", bird.build, 3,
          Promise(faces=(150, 600), **ANIMAL)),
    Model("mask", "carnival mask", mask.build, 3,
          Promise(faces=(100, 300), borders=3, **ANIMAL)),
    Model("house", "cottage of planar polygons", house.build, 3,
          Promise(faces=(20, 60), edge=0.02, angle=15.0, clearance=0.05)),
    Model("geodesic", "geodesic ball, frequency 3", polyhedra.build_geodesic,
          4, Promise(faces=(180, 180), **SOLID)),
    Model("star", "small stellated dodecahedron", polyhedra.build_star, 4,
          Promise(faces=(60, 60), **SOLID)),
    Model("torus", "low torus", tubes.build_torus, 4,
          Promise(faces=(150, 300), genus=1, **SOLID)),
    Model("knot", "trefoil knot", tubes.build_knot, 4,
          Promise(faces=(400, 800), genus=1, **SOLID)),
    Model("lampshade", "twisted, fluted lampshade, open at both ends",
          lampshade.build, 4,
          Promise(faces=(150, 300), borders=2, **SOLID)),
    Model("robot", "robot of many parts", robot.build, 3,
          Promise(faces=(200, 500), components=21, edge=0.01, angle=20.0,
                  clearance=0.05)),
    Model("lighthouse", "lighthouse on its rock, painted", lighthouse.build, 5,
          Promise(faces=(150, 350), edge=0.02, angle=10.0, clearance=0.05)),
    Model("balloon", "hot-air balloon", balloon.build, 4,
          Promise(faces=(150, 250), edge=0.02, angle=15.0, clearance=0.05)),
    Model("blouse-front", "front panel of a blouse, in centimetres",
          blouse.build, 3, Promise(faces=(500, 2000), borders=1, edge=0.01,
                                   angle=15.0, clearance=0.05)),
    Model("flat-bar", "flat bar to be bent by handles", flatbar.build, 3,
          Promise(faces=(640, 640), borders=1, **SOLID)),
    Model("tshirt", "T-shirt, its panels as groups", tshirt.build, 3,
          Promise(faces=(2500, 3500), borders=4, panels=4, **GARMENT)),
    Model("tshirt-plain", "T-shirt whose seams are still to be found",
          tshirt.build_plain, 3,
          Promise(faces=(2500, 3500), borders=4, **GARMENT)),
    Model("skirt", "A-line skirt with darts", skirt.build, 3,
          Promise(faces=(2000, 3000), borders=2, panels=2, **GARMENT)),
    Model("skirt-gores", "flared skirt of six gores", skirt.build_gores, 3,
          Promise(faces=(2000, 3000), borders=2, panels=6, **GARMENT)),
    Model("hat", "sun hat of six gores and a brim", hat.build, 3,
          Promise(faces=(1000, 2000), borders=1, panels=8, **GARMENT)),
    Model("plush-whale", "plush whale", plush.build, 3,
          Promise(faces=(1500, 3500), panels=11, **GARMENT)),
    Model("doll", "doll with its arms spread", doll.build, 3,
          Promise(faces=(1000, 2000), edge=0.01, angle=20.0,
                  clearance=0.05)),
    Model("sleeve", "sleeve in one panel, open under the arm, in centimetres",
          sleeve.build, 3, Promise(faces=(1000, 2000), borders=1, edge=0.01,
                                   angle=15.0, clearance=0.05)),
    Model("bracket", "bracket of thin plates: ribs, bolts, a cover",
          plates.build_bracket, 4,
          Promise(faces=(1000, 2000), components=2, ribs=50, edge=0.01,
                  angle=15.0, clearance=0.05)),
    Model("plates", "sixteen plates in a row", plates.build_row, 3,
          Promise(faces=(512, 512), components=16, borders=16, edge=0.01,
                  angle=40.0, clearance=0.05)),
    Model("dragon-egg", "dragon's egg, dense as a scan", egg.build, 3,
          Promise(faces=(20001, 30000), edge=0.0, angle=1.0,
                  starlike=(0.0, 0.0, 0.0))),
]
