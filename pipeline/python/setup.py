"""A wheel for any Python, or, where the built module was laid into the package's folder, for the
Python and the machine that it was built for. All else is said by pyproject.toml."""

from pathlib import Path

from setuptools import Distribution, setup


class WithModule(Distribution):
    def has_ext_modules(self) -> bool:
        return any((Path(__file__).parent / "blocklift").glob("_kernel*.so"))


setup(distclass=WithModule)
