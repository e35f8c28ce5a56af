"""Builds the wheel of `pip install .` with CMake and Python's own library: nothing is fetched."""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FILES = ["__init__.py", "__init__.pyi", "_error.py", "_toml.py", "py.typed"]


def _version():
    return re.search(r"project\(divot VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def _metadata():
    return (f"Metadata-Version: 2.1\nName: divot\nVersion: {_version()}\n"
            "Summary: Physically based terrain deformation in real time\nLicense: MIT\n"
            "Requires-Python: >=3.9\nRequires-Dist: numpy\n")


def _tag():
    python = "cp" + sysconfig.get_config_var("py_version_nodot")
    return f"{python}-{python}-" + re.sub(r"[^A-Za-z0-9]", "_", sysconfig.get_platform())


def _build_module(folder):
    """Compiles the module; returns its path."""
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))
    if not (pathlib.Path(folder) / "CMakeCache.txt").exists():  # DIVOT_BUILD may name a tree that is set up already
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DDIVOT_PYTHON=ON",
                        "-DDIVOT_VIEWER=OFF", "-DDIVOT_TESTS=OFF", *os.environ.get("DIVOT_CMAKE_ARGS", "").split()], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "divot_python", "--parallel", jobs], check=True)
    return next((pathlib.Path(folder) / "python" / "divot").glob("_divot*.so"))


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name, info = f"divot-{_version()}-{_tag()}.whl", f"divot-{_version()}.dist-info"
    with tempfile.TemporaryDirectory() as temporary:
        module = _build_module(os.environ.get("DIVOT_BUILD", temporary))
        contents = {"divot/" + file: (ROOT / "python" / "divot" / file).read_bytes() for file in FILES}
        contents["divot/" + module.name] = module.read_bytes()
    contents[info + "/METADATA"] = _metadata().encode()
    contents[info + "/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: divot\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode()
    contents[info + "/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = ""
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in contents.items():
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record += f"{path},sha256={digest},{len(data)}\n"
            wheel.writestr(path, data)
        wheel.writestr(info + "/RECORD", record + f"{info}/RECORD,,\n")
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("divot is built from its repository")
