#include <algorithm>
#include <array>

#include "drillstrand/result_file.hpp"
#include "results/hdf5.hpp"

namespace drillstrand {

bool is_own_result(const std::filesystem::path& path) {
    const hdf5::QuietErrors quiet;
    try {
        const H5::H5File file(path, H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT,
                              hdf5::file_access());
        const H5::Group root = file.openGroup("/");
        constexpr std::array written = {"title", "case", "version", "commit", "status"};
        return std::all_of(written.begin(), written.end(),
                           [&](const char* name) { return root.attrExists(name); });
    } catch (const H5::Exception&) {
        return false;
    }
}

}  // namespace drillstrand
