# Debian packages, one a component, which ../package makes.
set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_NAME earshot)
set(CPACK_PACKAGE_CONTACT "Earshot maintainers <maintainers@earshot.example>")  # put your own address here
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_SET_DESTDIR ON)  # /etc and /lib are beyond the prefix
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime sil tools hil dev)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
if(NOT CMAKE_CROSSCOMPILING)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # which packages the programs need; of another processor needed_packages says so
endif()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
# Version and time are the commit's: known when packages are made, not when the tree is configured.
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_BINARY_DIR}/cpack_options.cmake)
configure_file(cpack_options.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/cpack_options.cmake @ONLY)

# Debian's name of the processor that is built for, which is not always this machine's.
set(architecture ${CMAKE_SYSTEM_PROCESSOR})
if(architecture STREQUAL x86_64)
  set(architecture amd64)
elseif(architecture STREQUAL aarch64)
  set(architecture arm64)
elseif(architecture MATCHES "^arm")
  set(architecture armhf)
endif()
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${architecture})

set(processor "")
if(architecture STREQUAL armhf)
  set(processor "\nNeeds a processor with NEON (Cortex-A8 or newer), which Debian's armhf does\nnot promise.")
endif()

# describe(COMPONENT NAME DEPENDS RECOMMENDS SUMMARY TEXT): the summary of a line, and what stands below it. THIS_VERSION: of the packages, put in by cpack_options.
macro(describe COMPONENT NAME DEPENDS SUGGESTS SUMMARY TEXT)
  string(TOUPPER ${COMPONENT} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${NAME})
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${DEPENDS}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SUGGESTS "${SUGGESTS}")
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${SUMMARY}\n${TEXT}${processor}")
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${SUMMARY}\n${TEXT}${processor}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_${upper}_PACKAGE_PRIORITY optional)
endmacro()
describe(runtime earshot "adduser" "" "takes an underwater vehicle within earshot of a sound"
  "The program on the vehicle's computer (earshotd), its service, the policies\nand ocean tables that ship, missions to start from, and the commands that\nsign and verify missions and read journals.")
describe(sil earshot-sil "earshot (= THIS_VERSION)" "" "flies Earshot in a simulated ocean"
  "The ocean and the vehicle of a flight (earshot fly), its report, and the\nreplay of journals: software in the loop, on any computer.")
describe(tools earshot-tools "earshot-sil (= THIS_VERSION), gnuplot-nox | gnuplot" "" "trains, evaluates and freezes Earshot's policies"
  "Sound fields of an ocean, training, evaluation, freezing and explanation of\npolicies, ocean tables, a listener for recordings, and a decoder of CAN buses;\nwith the worlds that policies are tested in.")
describe(hil earshot-hil "earshot-sil (= THIS_VERSION), python3:any, iproute2, kmod" "user-mode-linux" "flies missions with faults on a CAN bus or over LCM"
  "The bench: over a hundred missions with faults, a vehicle's devices on a CAN\nbus, emulated, and a virtual CAN bus on any machine.")
describe(dev earshot-dev "libsodium-dev, libtomlplusplus-dev, liblcm-dev, pkg-config" "cmake, g++" "headers and libraries of Earshot's vehicle software"
  "For programs that speak to Earshot or are built around it:\nfind_package(Earshot) for CMake, the LCM types (.lcm), the simulation link\n(IDL) and the CAN messages (DBC).")
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)

# What a component's package does when it comes and goes.
set(control ${CMAKE_CURRENT_BINARY_DIR}/control)
file(READ control/guard.sh GUARD)  # a script of dpkg's cannot read another
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS control/guard.sh)
foreach(script preinst prerm postrm)
  configure_file(control/${script}.in ${control}/${script} @ONLY)
endforeach()
foreach(file postinst conffiles)
  configure_file(control/${file} ${control}/${file} COPYONLY)
endforeach()
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${control}/preinst ${control}/postinst ${control}/prerm ${control}/postrm ${control}/conffiles)
foreach(component SIL TOOLS HIL)
  set(CPACK_DEBIAN_${component}_PACKAGE_CONTROL_EXTRA ${control}/preinst ${control}/prerm)
endforeach()
# Without it apt would leave headers and libraries of the new version, unpacked and no more, beside programs of the old one.
set(CPACK_DEBIAN_DEV_PACKAGE_CONTROL_EXTRA ${control}/preinst)
include(CPack)
