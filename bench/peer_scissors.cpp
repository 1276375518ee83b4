// OpenCV's livewire, with gradient magnitude as its one feature: the smaller that is, the dearer the node.
#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/segmentation.hpp>

#include "peers.h"

namespace dstylize {

void scissors_map(const WeightedLattice& graph, NodeId source) {
    const Extent e = graph.lattice.extent();
    cv::Mat magnitude(e.y, e.x, CV_32F);
    for (int j = 0; j < e.y; ++j)
        for (int i = 0; i < e.x; ++i)
            magnitude.at<float>(j, i) = 255 - float(graph.weight[index(graph.lattice.at(i, j))]);
    const cv::Mat no_edges(e.y, e.x, CV_8U, cv::Scalar(0)), no_direction(e.y, e.x, CV_32FC2, cv::Scalar(0, 0));
    cv::segmentation::IntelligentScissorsMB scissors;
    scissors.setWeights(0, 0, 1);
    scissors.applyImageFeatures(no_edges, no_direction, magnitude);
    scissors.buildMap({graph.lattice.column(source), graph.lattice.row(source)});
}

}  // namespace dstylize
