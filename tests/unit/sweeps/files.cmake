# Sweeps on many ranks, in a program of their own: sixteen ranks share two cores.
signorini_add_unit_tests(sweeps RANKS "1;2;4;16" sweeps.cc)
