"""The list of all sample models with the promise each must keep."""

from collections import namedtuple

from . import bird, fox, whale
from .check import Promise

Model = namedtuple("Model", "name title build digits promise")

ANIMAL = dict(edge=0.02, angle=10.0, clearance=0.05)

MODELS = [
    Model("fox", "sitting fox", fox.build, 3,
          Promise(faces=(250, 500), **ANIMAL)),
    Model("whale", "humpback whale", whale.build, 3,
          Promise(faces=(150, 600), **ANIMAL)),
    Model("bird", "toucan", bird.build, 3,
          Promise(faces=(150, 600), **ANIMAL)),
]
