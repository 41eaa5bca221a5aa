# Filled in with the package export: cmake --install, then find_package(probegi).
