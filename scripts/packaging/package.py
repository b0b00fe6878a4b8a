# Spack recipe of gudgeon: packages/gudgeon/package.py of a repository of your own.
"""gudgeon: mechanisms whose joints are not perfect."""

from spack.package import *


class Gudgeon(MakefilePackage):
    """Simulates planar and spatial mechanisms with clearance, impacts, friction and films in their joints."""

    # of a checkout: spack dev-build gudgeon@main
    version("main")

    depends_on("c", type="build")
    depends_on("fortran", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("gmake", type="build")
    depends_on("hdf5+fortran+hl~mpi")
    depends_on("sundials@6:+fortran+klu+ida+cvode+arkode+kinsol~mpi")
    depends_on("suite-sparse")
    depends_on("lapack")
    depends_on("gnuplot", type="run")

    def edit(self, spec, prefix):
        env["FC"] = spack_fc
        env["CC"] = spack_cc
        env["SUNDIALS_DIR"] = spec["sundials"].prefix
        env["HDF5_DIR"] = spec["hdf5"].prefix
        env["SUITESPARSE_DIR"] = spec["suite-sparse"].prefix
        # three.js: set THREE_DIR to the unpacked npm package three@0.111 before the installation
        env["LAPACK"] = spec["lapack"].libs.ld_flags

    @property
    def install_targets(self):
        return ["install", f"PREFIX={self.prefix}"]
