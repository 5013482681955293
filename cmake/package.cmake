# A Debian package: cpack --config build/package/CPackConfig.cmake. README.md has the steps.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR seifbed)
set(CPACK_PACKAGE_CONTACT "the seifbed developers <seifbed@localhost>")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Loaded or called while it runs.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-roboto-unhinted")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libosmesa6, ffmpeg, gnuplot-nox, libjs-chart.js, libjs-three, python3-numpy, python3-pandas, python3-matplotlib")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libeigen3-dev")
set(CPACK_STRIP_FILES ON)
include(CPack)
