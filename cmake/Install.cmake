# Where everything goes with `cmake --install`; a prefix can be moved as a whole.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dstylize)

file(RELATIVE_PATH bin_to_lib /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
set_target_properties(dstylize_program PROPERTIES INSTALL_RPATH $ORIGIN/${bin_to_lib})

get_target_property(header_sets dstylize INTERFACE_HEADER_SETS)
list(TRANSFORM header_sets REPLACE "(.+)" "FILE_SET;\\1;DESTINATION;${CMAKE_INSTALL_INCLUDEDIR}/dstylize"
     OUTPUT_VARIABLE header_rules)
install(TARGETS dstylize EXPORT dstylize-targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ${header_rules})
install(TARGETS dstylize_program DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS dstylize-codec dstylize-codec-module DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/dstylize)

install(EXPORT dstylize-targets NAMESPACE dstylize:: DESTINATION ${package_dir})
file(WRITE ${PROJECT_BINARY_DIR}/dstylize-config.cmake
  "include(\${CMAKE_CURRENT_LIST_DIR}/dstylize-targets.cmake)\n")
write_basic_package_version_file(dstylize-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dstylize-config.cmake ${PROJECT_BINARY_DIR}/dstylize-config-version.cmake
  DESTINATION ${package_dir})

install(DIRECTORY filters/ DESTINATION ${CMAKE_INSTALL_DATADIR}/dstylize/styles FILES_MATCHING PATTERN *.toml)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES docs/dstylize.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES completions/dstylize.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME dstylize)
install(FILES completions/_dstylize DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES completions/dstylize.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
