# SPDX-License-Identifier: MIT
# Run by CPack on the packages that it has made, for what its generator of Debian's packages cannot do: says which
# packages may be installed for several architectures at once, and takes out scripts that call ldconfig, since a
# trigger does that now.
cmake_minimum_required(VERSION 3.22)

foreach(package IN LISTS CPACK_PACKAGE_FILES)
  set(folder ${package}.files)
  file(REMOVE_RECURSE ${folder})
  execute_process(COMMAND dpkg-deb --raw-extract ${package} ${folder} COMMAND_ERROR_IS_FATAL ANY)
  foreach(script IN ITEMS postinst postrm)
    if(EXISTS ${folder}/DEBIAN/${script})
      file(READ ${folder}/DEBIAN/${script} text)
      if(text MATCHES "ldconfig")
        file(REMOVE ${folder}/DEBIAN/${script})
      endif()
    endif()
  endforeach()
  file(READ ${folder}/DEBIAN/control control)
  if(control MATCHES "\nSection: lib")
    string(REPLACE "\nSource: " "\nMulti-Arch: same\nSource: " control "${control}")
    file(WRITE ${folder}/DEBIAN/control "${control}")
  endif()
  execute_process(COMMAND dpkg-deb --root-owner-group -Zxz --build ${folder} ${package} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE_RECURSE ${folder})
endforeach()
