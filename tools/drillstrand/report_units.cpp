#include "report_units.hpp"

#include "report_data.hpp"

namespace drillstrand::program {

std::string units_json() {
    const auto unit = [](const char* name, double factor) {
        return json_list({json_text(name), json_number(factor)});
    };
    const auto pair = [&](const UnitPair& units) {
        return json_object({{"si", unit(units.si_name, units.si)},
                            {"field", unit(units.field_name, units.field)}});
    };
    return json_object({{"time", pair(page_unit::time)},
                        {"step", pair(page_unit::step)},
                        {"length", pair(page_unit::length)},
                        {"small", pair(page_unit::small_length)},
                        {"force", pair(page_unit::force)},
                        {"moment", pair(page_unit::moment)},
                        {"energy", pair(page_unit::energy)},
                        {"sideForce", pair(page_unit::side_force)},
                        {"stress", pair(page_unit::stress)},
                        {"rotation", pair(page_unit::rotation)}});
}

}  // namespace drillstrand::program
