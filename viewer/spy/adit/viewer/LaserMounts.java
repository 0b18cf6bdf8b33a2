// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
package adit.viewer;

import java.util.HashMap;
import java.util.Map;

/** T_body_laser of each laser, from the section lasers of a CONFIG; the identity before that. */
final class LaserMounts {
    private final Map<String, PlanarPose> mounts = new HashMap<>();
    private final Map<String, Double> rangeMax = new HashMap<>();

    /** Takes the section from the YAML of a CONFIG, if it has one. True if anything changed. */
    boolean read(String yaml) {
        String before = toString();
        String section = "";
        String laser = "";
        Map<String, Double> values = new HashMap<>();
        for (String line : yaml.split("\n")) {
            String[] parts = line.replaceFirst("#.*", "").trim().split(":", 2);
            if (parts.length < 2) continue;
            int indent = line.length() - line.replaceFirst("^ +", "").length();
            if (indent == 0) section = parts[0];
            if (!section.equals("lasers")) continue;
            if (indent == 2) {
                laser = parts[0];
                values.clear();
            }
            if (indent < 4 || parts[1].trim().isEmpty()) continue;
            try {
                values.put(parts[0], Double.parseDouble(parts[1].trim()));
            } catch (NumberFormatException textual) {
                continue;
            }
            mounts.put(laser, new PlanarPose(values.getOrDefault("x_m", 0.0),
                    values.getOrDefault("y_m", 0.0), values.getOrDefault("theta_rad", 0.0)));
            if (values.containsKey("range_max_m")) rangeMax.put(laser, values.get("range_max_m"));
        }
        return !before.equals(toString());
    }

    /** Of the laser of a channel: LASER_FRONT is the laser front. */
    PlanarPose ofChannel(String channel) {
        return mounts.getOrDefault(laser(channel), PlanarPose.IDENTITY);
    }

    /** Readings at or beyond are no returns [m]. */
    double rangeMaxM(String channel) {
        return rangeMax.getOrDefault(laser(channel), 50.0);
    }

    private static String laser(String channel) {
        return channel.replaceFirst("^LASER_", "").toLowerCase(java.util.Locale.ROOT);
    }

    @Override
    public String toString() {
        StringBuilder text = new StringBuilder();
        for (Map.Entry<String, PlanarPose> mount : new java.util.TreeMap<>(mounts).entrySet()) {
            PlanarPose pose = mount.getValue();
            text.append(mount.getKey()).append(' ').append(pose.x).append(' ').append(pose.y)
                    .append(' ').append(pose.theta).append(' ')
                    .append(rangeMax.get(mount.getKey())).append(';');
        }
        return text.toString();
    }
}
