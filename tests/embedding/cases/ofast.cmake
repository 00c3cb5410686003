# -Ofast for everything, linking included: that adds code which sets the processor to flush denormal numbers to zero.
needs(g++)
configure(g++ -D PARENT_OPTIONS=-Ofast)
build()
answers()
