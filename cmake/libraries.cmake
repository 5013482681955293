# What the testbed uses beside Eigen.
find_package(PkgConfig REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(Freetype REQUIRED)
find_package(PNG REQUIRED)
# Headers alone: the library is loaded when a renderer is made, so that everything else works without it.
find_path(OSMESA_INCLUDE_DIR GL/osmesa.h REQUIRED)
find_path(OPENGL_CORE_INCLUDE_DIR GL/glcorearb.h REQUIRED)
add_library(OSMesa::headers INTERFACE IMPORTED)
set_target_properties(OSMesa::headers PROPERTIES
  INTERFACE_INCLUDE_DIRECTORIES "${OSMESA_INCLUDE_DIR};${OPENGL_CORE_INCLUDE_DIR}")
# The double-precision build: single precision leaves a millimetre grid at kilometre scale.
pkg_check_modules(bullet REQUIRED IMPORTED_TARGET bullet-float64)
# The shared library, which keeps its Eigen to itself. Ceres' own package file names the static one; the linker would
# mix its Eigen with ours, which -march=native aligns differently, and memory would be freed that nobody allocated.
find_path(CERES_INCLUDE_DIR ceres/problem.h REQUIRED)
find_library(CERES_LIBRARY libceres.so REQUIRED)
add_library(Ceres::ceres SHARED IMPORTED)
set_target_properties(Ceres::ceres PROPERTIES
  IMPORTED_LOCATION ${CERES_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${CERES_INCLUDE_DIR})
