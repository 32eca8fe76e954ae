// The published extractor of ROS: split and merge with weighted fits and their covariance (kam3k/laser_line_extraction,
// last C++ version for ROS 1), without ROS.
//
// git clone https://github.com/kam3k/laser_line_extraction lle
// g++ -O3 -march=native -I lle/include -I /usr/include/eigen3 laser_line_extraction.cpp lle/src/line.cpp \
//     lle/src/line_extraction.cpp -o judge && ./judge < scans.txt
// Needs Eigen and Boost. Its own defaults, but for lines of two points and of any length, which the scans need; each line of
// the input: first bearing, step (rad), then ranges in m. Prints the median time of a scan in µs and, for each scan, its
// segments.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>
#include "laser_line_extraction/line_extraction.h"

int main(int argc, char**) {
    std::string text;
    std::vector<double> times;
    while (std::getline(std::cin, text)) {
        std::istringstream in(text);
        double first, step, r;
        in >> first >> step;
        std::vector<double> ranges, bearings, cosines, sines;
        std::vector<unsigned int> indices;
        while (in >> r) {
            double b = first + step * ranges.size();
            indices.push_back(ranges.size());
            // It knows no greatest range: what did not return is nearer than its least.
            ranges.push_back(r < 90.0 ? r : 0.0);
            bearings.push_back(b); cosines.push_back(std::cos(b)); sines.push_back(std::sin(b));
        }
        line_extraction::LineExtraction extraction;
        extraction.setCachedData(bearings, cosines, sines, indices);
        extraction.setBearingVariance(1e-8); extraction.setRangeVariance(4e-4);
        extraction.setLeastSqAngleThresh(1e-4); extraction.setLeastSqRadiusThresh(1e-4);
        extraction.setMaxLineGap(0.4); extraction.setMinRange(0.01);
        extraction.setMinSplitDist(0.05); extraction.setOutlierDist(0.05);
        // An argument: its defaults in these too.
        extraction.setMinLineLength(argc > 1 ? 0.5 : 0.0); extraction.setMinLinePoints(argc > 1 ? 9 : 2);
        std::vector<line_extraction::Line> lines;
        std::vector<double> runs;
        for (int k = 0; k < 51; k++) {
            auto t = std::chrono::steady_clock::now();
            extraction.setRangeData(ranges);
            extraction.extractLines(lines);
            runs.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - t).count());
        }
        std::nth_element(runs.begin(), runs.begin() + 25, runs.end());
        times.push_back(runs[25]);
        for (auto& l : lines)
            std::printf("%.4f %.4f %.4f %.4f ", l.getStart()[0], l.getStart()[1], l.getEnd()[0], l.getEnd()[1]);
        std::printf("\n");
    }
    if (times.empty()) return 1;
    std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
    std::fprintf(stderr, "%.3f\n", times[times.size() / 2]);
}
