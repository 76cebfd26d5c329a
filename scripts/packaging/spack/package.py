"""A recipe for Spack. Not run: a start (docs/packages.md). Put the folder into a repository of packages,
and say where the source is: `spack develop --path CLONE splotchcl@0.1.0`."""

from spack.package import *


class Splotchcl(CMakePackage):
    """Renders particle simulations of the universe with OpenCL."""

    license("BSD-3-Clause")
    version("0.1.0")

    variant("python", default=True, description="Build the module for Python")

    depends_on("cxx", type="build")
    depends_on("c", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("opencl@1.2:")
    depends_on("boost@1.74:")
    depends_on("openimageio@2.3:")
    depends_on("openexr@3:")
    depends_on("libpng@1.6:")
    depends_on("zlib-api")
    depends_on("jpeg")
    depends_on("libtiff@4.5:")
    depends_on("stb")
    depends_on("freetype")
    depends_on("hdf5@1.10: ~mpi")
    depends_on("tomlplusplus")
    depends_on("cli11")
    depends_on("fmt")
    depends_on("spdlog +fmt_external")
    depends_on("nlohmann-json")
    depends_on("nanoflann")
    depends_on("fast-float")
    depends_on("libzip")
    depends_on("cfitsio")
    depends_on("libharu")
    depends_on("muparser@2.3:")
    with when("+python"):
        extends("python@3.10:")
        depends_on("py-numpy", type=("build", "run"))

    generator("ninja")

    def cmake_args(self):
        arguments = [
            self.define("SPLOTCHCL_TESTS", False),
            self.define("SPLOTCHCL_BENCH", False),
            self.define("CMAKE_INSTALL_LIBDIR", "lib"),
            self.define_from_variant("SPLOTCHCL_PYTHON", "python"),
        ]
        if self.spec.satisfies("+python"):
            folder = join_path(python_platlib, "splotchcl")
            arguments += [
                self.define("Python_EXECUTABLE", python.path),
                self.define("SPLOTCHCL_PYTHON_FOLDER", folder),
            ]
        return arguments

    @run_after("install", when="+python")
    def install_module(self):
        cmake("--install", self.build_directory, "--component", "python")
