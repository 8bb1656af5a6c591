# SPDX-License-Identifier: GPL-3.0-or-later
# Of the installed core: what its static library is linked with. CGAL is headers, but brings GMP and MPFR.
include(CMakeFindDependencyMacro)
find_dependency(CGAL 5.5)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(TBB)
include(${CMAKE_CURRENT_LIST_DIR}/hdpea-targets.cmake)
