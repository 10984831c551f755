# [[ clock.mark ]]
# Synopsys design constraints (Quartus, Efinity, Radiant, OpenSTA):
# [[ clock.top ]]'s clock. Put your board's frequency in; within a larger design the clock is defined already, and this
# file is not needed.
#
# rst_ni is synchronous, so its path is timed like any other: no false path for it. Where it comes from another clock, synchronise
# it outside the core with two registers and cut the path to the first of them:
#   set_false_path -to [get_cells reset_synchroniser_q_reg[0]]
# Everything else of the core lies between registers of clk_i; its other ports are meant for logic, not for pins.
create_clock -name clk_i -period [[ clock.example_ns ]] [get_ports clk_i]
