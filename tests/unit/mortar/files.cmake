signorini_add_unit_tests(mortar RANKS "1;2"
  two_step_rule.cc
)
