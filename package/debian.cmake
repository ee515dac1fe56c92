# The components as Debian packages: ./bootstrap package, or cpack -G DEB in the build folder.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "gramloom maintainers <maintainers@gramloom.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# What is linked. Our own libraries are no package's; those opened at run time are linked by our modules.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})

configure_file(${CMAKE_CURRENT_LIST_DIR}/changelog.in ${PROJECT_BINARY_DIR}/package/changelog @ONLY)
find_program(GZIP_PROGRAM gzip REQUIRED)
execute_process(COMMAND ${GZIP_PROGRAM} -9nkf ${PROJECT_BINARY_DIR}/package/changelog COMMAND_ERROR_IS_FATAL ANY)

# debian_package(COMPONENT PACKAGE SUMMARY TEXT [FIELD VALUE ...]): FIELDs as CPACK_DEBIAN_PACKAGE_ has them.
function(debian_package component package summary text)
  install(FILES package/copyright ${PROJECT_BINARY_DIR}/package/changelog.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
  string(TOUPPER CPACK_DEBIAN_${component} prefix)
  set(${prefix}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(${prefix}_DESCRIPTION "${summary}\n${text}" PARENT_SCOPE)
  while(ARGN)
    list(POP_FRONT ARGN field value)
    set(${prefix}_PACKAGE_${field} "${value}" PARENT_SCOPE)
  endwhile()
endfunction()

set(what "gramloom makes new textures from a small picture of one: pictures of any\nsize that look like more of the same, and that tile.")
set(same_version "(= ${PROJECT_VERSION})")
debian_package(program gramloom "new textures from a small picture of one"
  "${what} It copies patches and\npixels, matches statistics, or makes textures from formulas alone; it\nscores what it made, and shows it on a page."
  RECOMMENDS "gramloom-neural ${same_version}")
# Without an optimised BLAS, a picture takes several times as long. Those of threads of their own get in the
# way of LibTorch's.
debian_package(neural gramloom-neural "new textures from a small picture of one: neural methods"
  "${what}\n.\nThis package has the part that needs LibTorch: the method neural, and\ntraining."
  DEPENDS "gramloom ${same_version}, libopenblas0-openmp")
debian_package(development libgramloom-dev "new textures from a small picture of one: libraries"
  "${what}\n.\nThis package has headers, libraries and a CMake package for programs that\nuse its methods."
  DEPENDS "gramloom ${same_version}, libfmt-dev, libimath-dev, libopencv-core-dev, libopencv-imgproc-dev, libpugixml-dev, libtomlplusplus-dev, nlohmann-json3-dev"
  RECOMMENDS "gramloom-neural ${same_version}"
  SECTION libdevel)
get_cmake_property(components COMPONENTS)
if(python IN_LIST components)
  # An extension is of one version of Python.
  execute_process(COMMAND ${GRAMLOOM_PYTHON_EXECUTABLE} -c
    "from sys import version_info as v; print(f'python3 (>= {v[0]}.{v[1]}), python3 (<< {v[0]}.{v[1] + 1})', end='')"
    OUTPUT_VARIABLE python COMMAND_ERROR_IS_FATAL ANY)
  debian_package(python python3-gramloom "new textures from a small picture of one: Python module"
    "${what}\n.\nThis package has the module gramloom for Python 3 and NumPy."
    DEPENDS "gramloom ${same_version}, ${python}, python3-numpy"
    RECOMMENDS "gramloom-neural ${same_version}"
    SECTION python)
endif()
include(CPack)
