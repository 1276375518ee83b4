#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "graph/planner.h"

// A row of planner_bench's first table: a graph, its sources, and all who plan it.
namespace dstylize {

/// Peers give other answers: then times mean nothing.
struct Disagreement : std::runtime_error {
    using std::runtime_error::runtime_error;
};

enum class Edges { weights8, planes8, planes16, falling16, irregular };

/// Where paths start. `grown` and `carried` are what a stage leaves to the next one: the paths of a plan before from
/// endpoints to its source, where the nodes of `carried` start with half their distance from it. `grown_twice` is what
/// two rounds of a stage leave: as many paths more, from a plan of `grown`.
enum class Starts { one, owners100, owners1000, grown, carried, grown_twice };

/// Ratios that are to be reached: time of a peer to that of tiles with one thread and with two. 0: none.
struct Bars {
    double heap = 0, heap_by_two = 0, boost = 0, boost_by_two = 0;
};

struct Row {
    std::string map;
    Metric metric;
    Edges edges;
    Bars bars{};
    Starts starts = Starts::one;
    bool again = false;  ///< the tiles plan with the plan before as `PlanRequest::earlier`
};

/// How a row is called: "portrait, sum, weights, 8", and what is special about its sources.
std::string name_of(const Row& row);

/// Nanoseconds per node; 0 where that peer does not apply.
struct Times {
    double tiles = 0, tiles_by_two = 0, bucket = 0, heap = 0, boost = 0, scissors = 0;
};

/// One of our times beside another one.
struct OwnRatio {
    std::string name;
    double value = 0, bar = 0;  ///< no bar: 0
    bool at_most = false;       ///< what the bar is; else at least
    bool by_two = false;        ///< says nothing where there is one processor
};

struct Measured {
    Times times;
    std::vector<OwnRatio> ratios;
};

/// Throws Disagreement.
Measured measured(const Row& row, double mega);

/// The flood of the stippling, which has no peer but the heap, and how many points it places.
Times measured_stippling(double mega, std::size_t& count);

}  // namespace dstylize
