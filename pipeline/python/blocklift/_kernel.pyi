# The module of pipeline/python/kernel.cc.
from .kernel import LawOrClass

#: Of the program that the module was built with.
version: str

def simulate(case: str, folder: str, program: str, laws: dict[str, LawOrClass],
             set: list[str]) -> None: ...
def assess(case: str, folder: str, program: str, laws: dict[str, LawOrClass],
           decks: bool, set: list[str]) -> None: ...
def sweep(study: str, folder: str, program: str, laws: dict[str, LawOrClass]) -> list[str]: ...
