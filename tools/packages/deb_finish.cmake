# What CPack runs between installing into a folder for each package and packing it: puts in what Debian
# expects of a package, and moves what it has elsewhere.
set(share ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/tools/usr/share)
set(debian ${CPACK_TREEFORM_SOURCE}/tools/packages/debian)

# gzip_into(FILE FOLDER): no time and no name within, so that the bytes depend on FILE alone.
function(gzip_into file folder)
    file(MAKE_DIRECTORY ${folder})
    cmake_path(GET file FILENAME name)
    execute_process(COMMAND gzip -9nc ${file} OUTPUT_FILE ${folder}/${name}.gz
        COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(GLOB pages ${share}/man/man1/*.1)
foreach(page IN LISTS pages)
    gzip_into(${page} ${share}/man/man1)
    file(REMOVE ${page})
endforeach()
if(EXISTS ${share}/zsh/site-functions)
    file(RENAME ${share}/zsh/site-functions ${share}/zsh/vendor-completions)
endif()

# The changelog of the package: its version is all that there is to say beside upstream's.
if(DEFINED ENV{SOURCE_DATE_EPOCH})
    set(date --date=@$ENV{SOURCE_DATE_EPOCH})
endif()
execute_process(COMMAND env LC_ALL=C TZ=UTC date -R ${date}
    OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set(changelog ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/changelog.Debian)
set(version ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
file(WRITE ${changelog} "treeform (${version}) unstable; urgency=medium

  * Upstream release; what changed is in changelog.gz.

 -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${date}
")
configure_file(${CPACK_TREEFORM_SOURCE}/CHANGELOG.md
    ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/changelog COPYONLY)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
    string(TOUPPER ${component} upper)
    set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
    set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr/share)
    gzip_into(${changelog} ${root}/doc/${name})
    gzip_into(${CPACK_TEMPORARY_INSTALL_DIRECTORY}/changelog ${root}/doc/${name})
    configure_file(${debian}/copyright ${root}/doc/${name}/copyright COPYONLY)
    if(EXISTS ${debian}/${component}.lintian-overrides)
        configure_file(${debian}/${component}.lintian-overrides
            ${root}/lintian/overrides/${name} @ONLY)
    endif()
    file(GLOB_RECURSE files ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr/share/*)
    file(CHMOD ${files} PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
endforeach()
file(REMOVE ${changelog} ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/changelog)
