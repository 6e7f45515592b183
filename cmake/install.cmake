# Installs the library as the CMake package `holdfast`, target holdfast::holdfast, and as the pkg-config module
# `holdfast`; with the program comes its manual page. `cpack` in the build folder packs all of it.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/holdfast)
install(TARGETS holdfast EXPORT holdfast-targets)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/holdfast DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT holdfast-targets NAMESPACE holdfast:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/holdfast-config.cmake.in
                              ${PROJECT_BINARY_DIR}/holdfast-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/holdfast-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/holdfast-config.cmake ${PROJECT_BINARY_DIR}/holdfast-config-version.cmake
        DESTINATION ${package_dir})

# pkg-config. Paths are relative to the file, so that the package may be moved.
file(RELATIVE_PATH HOLDFAST_PC_TO_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" HOLDFAST_PC_TO_PREFIX "${HOLDFAST_PC_TO_PREFIX}")
get_target_property(kind holdfast TYPE)
if(HOLDFAST_METIS_LIBRARIES)
  set(optional " -lmetis")
endif()
if(HOLDFAST_LZMA_LIBRARIES)
  string(APPEND optional " -llzma")
endif()
if(kind STREQUAL "STATIC_LIBRARY")
  # There is no shared library that would bring these; a C program links the C++ runtime, too.
  if(CMAKE_CXX_FLAGS MATCHES "-stdlib=libc\\+\\+")
    set(HOLDFAST_PC_LIBS "-lz -pthread -lc++ -lm${optional}")
  else()
    set(HOLDFAST_PC_LIBS "-lz -pthread -lstdc++ -lm${optional}")
  endif()
else()
  set(HOLDFAST_PC_REQUIRES_PRIVATE zlib)
  set(HOLDFAST_PC_LIBS_PRIVATE "-pthread${optional}")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/holdfast.pc.in ${PROJECT_BINARY_DIR}/holdfast.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/holdfast.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(TARGET holdfast_cli)
  configure_file(${PROJECT_SOURCE_DIR}/docs/holdfast.1.in ${PROJECT_BINARY_DIR}/holdfast.1 @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/holdfast.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

install(FILES ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/LICENSE-MIT ${PROJECT_SOURCE_DIR}/LICENSE-APACHE
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

# `cpack` in the build folder: a .tar.gz and a .deb of the library, its headers and the program.
set(CPACK_GENERATOR "TGZ;DEB")
set(CPACK_PACKAGE_NAME holdfast)
set(CPACK_PACKAGE_VENDOR "Holdfast")
set(CPACK_PACKAGE_CONTACT "The Holdfast developers <holdfast@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_STRIP_FILES ON)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE-MIT)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# A static library needs those that it stands on where a program links it.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "zlib1g-dev, pkg-config")
if(HOLDFAST_METIS_LIBRARIES)
  string(APPEND CPACK_DEBIAN_PACKAGE_RECOMMENDS ", libmetis-dev")
endif()
if(HOLDFAST_LZMA_LIBRARIES)
  string(APPEND CPACK_DEBIAN_PACKAGE_RECOMMENDS ", liblzma-dev")
endif()
set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_IGNORE_FILES "/build/;/\\\\.git/")
include(CPack)
