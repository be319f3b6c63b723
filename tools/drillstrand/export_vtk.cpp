#include "export_vtk.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "export_fields.hpp"

namespace drillstrand::program {

namespace {

namespace fs = std::filesystem;

constexpr const char* byte_order =
    std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

/// The numbers at the end of a file, each array behind the count of its bytes.
class AppendedData {
  public:
    /// Appends an array; returns what a DataArray says of it.
    template <class Number>
    std::string add(const char* type, const std::string& attributes,
                    const std::vector<Number>& values) {
        std::string element =
            fmt::format("<DataArray type=\"{}\" {} format=\"appended\" offset=\"{}\"/>\n", type,
                        attributes, bytes_.size());
        const std::uint64_t count = values.size() * sizeof(Number);
        bytes_.append(reinterpret_cast<const char*>(&count), sizeof count);
        bytes_.append(reinterpret_cast<const char*>(values.data()), count);
        return element;
    }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

/// Lines through points, with values at the points and on the lines.
struct LineData {
    std::vector<double> points;              ///< three per point (m)
    std::vector<std::int64_t> connectivity;  ///< points of the first line, of the second...
    std::vector<std::int64_t> offsets;       ///< where in `connectivity` each line ends
    std::vector<ExportField> of_points;
    std::vector<ExportField> of_lines;
};

std::string fields_text(const char* where, const std::vector<ExportField>& fields,
                        AppendedData& data) {
    std::string text = fmt::format("<{}>\n", where);
    for (const ExportField& field : fields) {
        std::string attributes = fmt::format(R"(Name="{}" NumberOfComponents="{}")",
                                             with_units(field.name, field.units), field.width());
        for (std::size_t k = 0; k < field.components.size(); ++k)
            attributes += fmt::format(" ComponentName{}=\"{}\"", k, field.components[k]);
        text += data.add("Float64", attributes, field.values);
    }
    return text + fmt::format("</{}>\n", where);
}

std::string time_text(double time, AppendedData& data) {
    return "<FieldData>\n" +
           data.add("Float64", R"(Name="TimeValue" NumberOfTuples="1")",
                    std::vector<double>{time}) +
           "</FieldData>\n";
}

std::string piece_text(const LineData& lines, AppendedData& data) {
    std::string text = fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfLines=\"{}\">\n",
                                   lines.points.size() / 3, lines.offsets.size());
    text += fields_text("PointData", lines.of_points, data);
    text += fields_text("CellData", lines.of_lines, data);
    text += "<Points>\n";
    text += data.add("Float64", R"(Name="Points" NumberOfComponents="3")", lines.points);
    text += "</Points>\n<Lines>\n";
    text += data.add("Int64", "Name=\"connectivity\"", lines.connectivity);
    text += data.add("Int64", "Name=\"offsets\"", lines.offsets);
    return text + "</Lines>\n</Piece>\n";
}

std::string opening_text(const char* type) {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<!-- made by drillstrand -->\n<VTKFile type=\"{}\" "
        "version=\"1.0\" byte_order=\"{}\" "
        "header_type=\"UInt64\">\n",
        type, byte_order);
}

void write_lines(const fs::path& path, const LineData& lines, const double* time,
                 Existing existing) {
    AppendedData data;
    std::string text = opening_text("PolyData") + "<PolyData>\n";
    if (time != nullptr) text += time_text(*time, data);
    text += piece_text(lines, data) + "</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    NewFile file(path, existing);
    file.write(text);
    file.write(data.bytes());
    file.write("\n</AppendedData>\n</VTKFile>\n");
    file.take_name();
}

void append(std::vector<double>& values, const Eigen::Vector3d& point) {
    values.insert(values.end(), point.begin(), point.end());
}

LineData string_lines(const Profile& profile, ProfileFields& fields) {
    LineData lines;
    for (const Eigen::Vector3d& point : profile.position)
        append(lines.points, point);
    for (std::int64_t k = 0; k + 1 < std::ssize(profile.position); ++k) {
        lines.connectivity.insert(lines.connectivity.end(), {k, k + 1});
        lines.offsets.push_back(std::ssize(lines.connectivity));
    }
    lines.of_points = fields.of_nodes(profile);
    lines.of_lines = fields.of_segments(profile);
    return lines;
}

LineData well_lines(const std::vector<WellStretch>& stretches) {
    LineData lines;
    ExportField depth{"measured_depth", "m", {}, {}};
    ExportField radius{"radius", "m", {}, {}};
    for (const WellStretch& stretch : stretches) {
        for (const Eigen::Vector3d& point : stretch.axis)
            append(lines.points, point);
        depth.values.insert(depth.values.end(), stretch.measured_depth.begin(),
                            stretch.measured_depth.end());
        radius.values.resize(depth.values.size(), stretch.radius);
        lines.offsets.push_back(std::ssize(depth.values));
    }
    lines.connectivity.resize(depth.values.size());
    std::iota(lines.connectivity.begin(), lines.connectivity.end(), 0);
    lines.of_points = {depth, radius};
    return lines;
}

std::string string_name(std::size_t k) {
    return fmt::format("string_{:05}.vtp", k);
}

constexpr const char* well_name = "well.vtp";
constexpr const char* collection_name = "string.pvd";

}  // namespace

std::vector<fs::path> vtk_files(const fs::path& folder, const Result& result) {
    std::vector<fs::path> files{folder / collection_name};
    if (result.header.well) files.push_back(folder / well_name);
    for (std::size_t k = 0; k < result.profiles.size(); ++k)
        files.push_back(folder / string_name(k));
    return files;
}

void write_vtk(const fs::path& folder, const Result& result, Existing existing) {
    if (result.header.well)
        write_lines(folder / well_name, well_lines(well_stretches(result)), nullptr, existing);
    ProfileFields fields(result);
    std::string collection = opening_text("Collection") + "<Collection>\n";
    for (std::size_t k = 0; k < result.profiles.size(); ++k) {
        const Profile& profile = result.profiles[k];
        write_lines(folder / string_name(k), string_lines(profile, fields), &profile.time,
                    existing);
        collection += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n",
                                  profile.time, string_name(k));
    }
    NewFile file(folder / collection_name, existing);
    file.write(collection + "</Collection>\n</VTKFile>\n");
    file.take_name();
}

}  // namespace drillstrand::program
