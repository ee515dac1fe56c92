# What `cmake --install` lays where. Each component becomes a Debian package (debian.cmake).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(${CMAKE_CURRENT_LIST_DIR}/public_headers.cmake)
set(libraries lib/gramloom)  # where the program looks for them

# --- program, and neural: the modules that bring LibTorch along ------------------------------------------
install(TARGETS gramloom RUNTIME DESTINATION bin COMPONENT program)
install(TARGETS gramloom_core gramloom_signal gramloom_io EXPORT gramloom
        LIBRARY DESTINATION ${libraries} COMPONENT program)
function(install_modules component)
  foreach(module ${ARGN})
    install(TARGETS gramloom_${module}_module LIBRARY DESTINATION ${libraries} COMPONENT ${component})
    install(FILES ${PROJECT_BINARY_DIR}/libgramloom_${module}.txt DESTINATION ${libraries} COMPONENT ${component})
  endforeach()
endfunction()
install_modules(program pictures learnt surface)
install_modules(neural neural train)

# The configs name their pictures by ../data.
install(DIRECTORY configs models data DESTINATION ${CMAKE_INSTALL_DATADIR}/gramloom COMPONENT program
        PATTERN data/readme EXCLUDE)
install(PROGRAMS configs/cluster/array.sbatch DESTINATION ${CMAKE_INSTALL_DATADIR}/gramloom/configs/cluster
        COMPONENT program)
# In no package: Debian has the text of this licence elsewhere, and wants no other copy.
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
# What these pages show and link lies beside them as it does here.
install(DIRECTORY data/readme DESTINATION ${CMAKE_INSTALL_DOCDIR}/data COMPONENT program)
install(FILES models/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/models COMPONENT program)
install(FILES tests/golden/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/tests/golden COMPONENT program)
install(FILES configs/cluster/array.sbatch DESTINATION ${CMAKE_INSTALL_DOCDIR}/configs/cluster COMPONENT program)

# The manual and completions: the program prints them.
install(CODE "
  set(executable \"${PROJECT_BINARY_DIR}/gramloom\")
  set(share \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}\")
  execute_process(COMMAND \"\${executable}\" manual --output \"\${share}/man\" COMMAND_ERROR_IS_FATAL ANY)
  find_program(GZIP_PROGRAM gzip)
  if(GZIP_PROGRAM)
    file(GLOB pages \"\${share}/man/man*/gramloom*.[15]\")
    execute_process(COMMAND \${GZIP_PROGRAM} -9nf \${pages} COMMAND_ERROR_IS_FATAL ANY)
  endif()
  foreach(completion bash:bash-completion/completions/gramloom zsh:zsh/vendor-completions/_gramloom
                     fish:fish/vendor_completions.d/gramloom.fish)
    string(REPLACE \":\" \";\" parts \"\${completion}\")
    list(GET parts 0 shell)
    list(GET parts 1 file)
    get_filename_component(folder \"\${share}/\${file}\" DIRECTORY)
    file(MAKE_DIRECTORY \"\${folder}\")
    execute_process(COMMAND \"\${executable}\" completion \${shell} OUTPUT_FILE \"\${share}/\${file}\"
                    COMMAND_ERROR_IS_FATAL ANY)
  endforeach()" COMPONENT program)

# --- development: gramloom::FOLDER for each folder but the program's own ----------------------------------
set(folders core signal io runs procedural classic metrics neural learnt train surface jobs report)
foreach(folder ${folders})
  set_target_properties(gramloom_${folder} PROPERTIES EXPORT_NAME ${folder})
  if(TARGET gramloom_${folder}_and_module)  # the name stands for both, as in this project
    set_target_properties(gramloom_${folder} PROPERTIES EXPORT_NAME ${folder}_library)
    set_target_properties(gramloom_${folder}_and_module PROPERTIES EXPORT_NAME ${folder})
    install(TARGETS gramloom_${folder}_and_module EXPORT gramloom)
  endif()
  get_target_property(type gramloom_${folder} TYPE)
  if(type STREQUAL STATIC_LIBRARY)
    install(TARGETS gramloom_${folder} EXPORT gramloom ARCHIVE DESTINATION ${libraries} COMPONENT development)
  endif()
endforeach()
set_target_properties(gramloom_options PROPERTIES EXPORT_NAME options)
install(TARGETS gramloom_options EXPORT gramloom)

gramloom_public_headers(headers ${folders})
foreach(header ${headers})
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES src/${header} DESTINATION include/gramloom/${folder} COMPONENT development)
endforeach()
configure_file(src/core/version.h.in ${PROJECT_BINARY_DIR}/package/version.h @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/package/version.h DESTINATION include/gramloom/core COMPONENT development)

install(EXPORT gramloom NAMESPACE gramloom:: FILE gramloomTargets.cmake DESTINATION lib/cmake/gramloom
        COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/gramloomConfig.cmake.in
  ${PROJECT_BINARY_DIR}/package/gramloomConfig.cmake INSTALL_DESTINATION lib/cmake/gramloom)
# The libraries' functions may still change with any minor version.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/gramloomConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/gramloomConfig.cmake ${PROJECT_BINARY_DIR}/package/gramloomConfigVersion.cmake
        DESTINATION lib/cmake/gramloom COMPONENT development)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libgramloom-dev COMPONENT development)

# All that is installed, as a target.
add_custom_target(installed DEPENDS gramloom gramloom_train_module)
if(TARGET gramloom_python)
  add_dependencies(installed gramloom_python)
endif()
