# -march=native: instruction sets that are part of what every function may use anyway are left out, but for the best of them.
needs(g++ -march=native)
configure(g++ -D "PARENT_OPTIONS=-O1 -march=native")
build()
if(machine_has_avx512)
  answers("scalar: as on record\nportable128: as on record\navx512: as on record\n")
else()
  answers()
endif()
