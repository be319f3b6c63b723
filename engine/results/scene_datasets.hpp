/// The string and the well in a result file: what pictures and other programs need of the scene,
/// because the tables that a case file names may be gone.
#pragma once

#include "results/reading.hpp"

namespace drillstrand::hdf5 {

/// Writes the groups /string and /well, each only where the header has it.
void write_scene(H5::H5File& file, const ResultHeader& header);

/// Reads what write_scene() wrote. What a file does not have (files of older versions have
/// neither) stays empty. The mesh must have been read.
void read_scene(UntrustedFile& file, ResultHeader& header);

}  // namespace drillstrand::hdf5
