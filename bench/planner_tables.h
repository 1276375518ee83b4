#pragma once

// The tables of planner_bench that it prints instead of the one beside the peers. False where a bar is missed.
namespace dstylize {

/// How the time of a node grows with the picture, up to so many million nodes; from 0.25 to 24 it should not.
bool show_growth(double largest);

/// What one plan by one thread holds at its peak beyond the weights, of so many million nodes.
bool show_memory(double mega);

}  // namespace dstylize
