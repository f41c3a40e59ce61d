# The module of pipeline/python/kernel.cc.
from .kernel import LawOrClass

#: Of the program that the module was built with.
version: str

def simulate(case: str, folder: str, program: str, laws: dict[str, LawOrClass]) -> None: ...
