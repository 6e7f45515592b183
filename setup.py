"""Builds the extension module and the program by CMake; everything else is in pyproject.toml."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).parent.resolve()


def version() -> str:
    header = (ROOT / "include/holdfast/version.h").read_text()
    return ".".join(re.search(rf"HOLDFAST_VERSION_{part} (\d+)", header).group(1) for part in ("MAJOR", "MINOR", "PATCH"))


class CMakeBuild(build_ext):
    """One extension: the whole of CMake's targets holdfast_python and holdfast_cli."""

    def build_extension(self, ext: Extension) -> None:
        destination = Path(self.get_ext_fullpath(ext.name)).resolve()
        if done := os.environ.get("HOLDFAST_BUILD_DIR"):  # that of a build with HOLDFAST_BUILD_PYTHON, for tests
            return self.take(Path(done), destination)
        build = Path(self.build_temp).resolve() / "cmake"
        options = [
            "-DCMAKE_BUILD_TYPE=Release", "-DHOLDFAST_BUILD_PYTHON=ON", "-DHOLDFAST_BUILD_CLI=ON",
            "-DHOLDFAST_BUILD_TESTS=OFF", "-DHOLDFAST_BUILD_EXAMPLES=OFF", "-DHOLDFAST_INSTALL=OFF",
            "-DHOLDFAST_WERROR=OFF", f"-DHOLDFAST_PYTHON={sys.executable}", *self.pybind11_of_pip(),
        ]
        if shutil.which("ninja"):
            options += ["-G", "Ninja"]
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), *options], check=True)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        subprocess.run(["cmake", "--build", str(build), "-j", jobs, "--target", "holdfast_python", "holdfast_cli"], check=True)
        self.take(build, destination)

    @staticmethod
    def take(build: Path, destination: Path) -> None:
        destination.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(next((build / "python/holdfast").glob("_core.*")), destination)
        (destination.parent / "bin").mkdir(exist_ok=True)
        shutil.copy2(build / "holdfast", destination.parent / "bin/holdfast")
        subprocess.run(["strip", "--strip-unneeded", str(destination), str(destination.parent / "bin/holdfast")], check=False)

    @staticmethod
    def pybind11_of_pip() -> list:
        """Where pybind11 was installed as a Python package, CMake has to be told; Debian's is found."""
        try:
            import pybind11

            folder = Path(pybind11.get_cmake_dir())
        except ImportError:
            return []
        return [f"-Dpybind11_DIR={folder}"] if folder.is_dir() else []


setup(version=version(), ext_modules=[Extension("holdfast._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
