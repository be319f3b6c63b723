/// Sensors and cycles in a result file: what a case asks for in its table [output].
#pragma once

#include "drillstrand/result_file.hpp"
#include "results/reading.hpp"

namespace drillstrand::hdf5 {

/// Writes the group /sensors with a group for each sensor, where the header has any. Records are
/// not written.
void write_sensors(H5::H5File& file, const ResultHeader& header);
/// Reads what write_sensors() wrote.
void read_sensors(const UntrustedFile& file, ResultHeader& header);

/// Writes the group /cycles, of no cycles, where the header has them counted.
void write_cycles(H5::H5File& file, const ResultHeader& header);
/// Brings its values up to date; none are written where none are counted.
void rewrite_cycles(H5::H5File& file, const SegmentCycles& cycles);
/// Reads both. The mesh must have been read.
void read_cycles(UntrustedFile& file, ResultHeader& header, SegmentCycles& cycles);

}  // namespace drillstrand::hdf5
