// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
package adit.viewer;

import adit.cloud_line_t;
import adit.cloud_t;
import adit.config_t;
import adit.local_map_t;
import adit.local_scan_t;
import adit.map_correction_t;
import adit.path_point_t;
import adit.planned_path_t;
import adit.pose_constraint_t;
import adit.pose_graph_t;
import adit.pose_t;
import adit.terrain_t;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/**
 * What the messages of a mission say of the mine, in the frames of the messages: local maps at the
 * poses of the pose graph, in map; terrain, path, 3D scan and robot in odom, which MAP_CORRECTION
 * places in map. Messages of other versions are ignored. Not for concurrent use.
 */
final class MineScene {
    /** Points of a local map, in its frame. */
    static final class LocalMap {
        long endUtime;
        final Map<Integer, local_scan_t[]> fragments = new TreeMap<>();
        float[] points;  // x, y, x, y, .. [m]; null until they are needed

        void add(local_map_t message) {
            if (message.end_utime < endUtime) return;
            if (message.end_utime > endUtime) fragments.clear();
            endUtime = message.end_utime;
            fragments.put(message.fragment, message.scans);
            points = null;
        }

        float[] points(LaserMounts mounts) {
            if (points == null) points = pointsOf(fragments.values(), mounts);
            return points;
        }
    }

    /** A terrain map: its cells row by row. */
    static final class Terrain {
        PlanarPose T_odom_level = PlanarPose.IDENTITY;
        double cornerX;
        double cornerY;
        double cellM;
        int columns;
        int rows;
        byte[] ground;
        short[] coefficientMm;
    }

    private static final long CELLS_MAX = 4_000_000;

    final Map<Integer, LocalMap> localMaps = new TreeMap<>();
    final LaserMounts mounts = new LaserMounts();
    /** T_map_local by the id of the local map; null where a fragment is missing. */
    PlanarPose[] poses = {};
    List<pose_constraint_t> constraints = new ArrayList<>();
    PlanarPose T_map_odom = PlanarPose.IDENTITY;
    PlanarPose T_odom_body;
    /** Of the newest POSE [us since the epoch]. */
    long utime;
    Terrain terrain;
    planned_path_t path;
    final List<cloud_line_t> cloud = new ArrayList<>();
    PlanarPose T_odom_cloud = PlanarPose.IDENTITY;

    private long graphRevision = Long.MIN_VALUE;
    private int terrainId = Integer.MIN_VALUE;
    private int cloudId = Integer.MIN_VALUE;
    private long cloudUtime;
    private long terrainUtime;

    void add(local_map_t message) {
        localMaps.computeIfAbsent(message.id, id -> new LocalMap()).add(message);
    }

    void add(config_t message) {
        if (!mounts.read(message.yaml)) return;
        for (LocalMap map : localMaps.values()) map.points = null;
    }

    void add(pose_graph_t message) {
        boolean isNew = message.revision != graphRevision || poses.length != message.n_nodes;
        if (isNew && message.n_nodes >= 0 && message.n_nodes < CELLS_MAX) {
            PlanarPose[] before = poses;
            poses = new PlanarPose[message.n_nodes];
            System.arraycopy(before, 0, poses, 0, Math.min(before.length, poses.length));
            constraints = new ArrayList<>();
            graphRevision = message.revision;
        }
        for (int i = 0; i < message.n_poses; ++i) {
            int node = message.first_node + i;
            if (node >= 0 && node < poses.length) poses[node] = PlanarPose.of(message.poses[i]);
        }
        for (pose_constraint_t constraint : message.constraints) constraints.add(constraint);
    }

    void add(map_correction_t message) {
        T_map_odom = PlanarPose.of(message.T_map_odom);
    }

    void add(pose_t message) {
        utime = message.utime;
        double[] q = message.orientation;  // w, x, y, z
        double yaw = Math.atan2(2 * (q[0] * q[3] + q[1] * q[2]),
                1 - 2 * (q[2] * q[2] + q[3] * q[3]));
        T_odom_body = new PlanarPose(message.pos[0], message.pos[1], yaw);
    }

    void add(terrain_t message) {
        long cells = (long) message.columns * message.rows;
        if (message.columns <= 0 || message.rows <= 0 || cells > CELLS_MAX) return;
        if (terrain == null || message.id != terrainId || message.utime != terrainUtime) {
            terrain = new Terrain();
            terrain.ground = new byte[(int) cells];
            java.util.Arrays.fill(terrain.ground, terrain_t.GROUND_NEVER_OBSERVED);
            terrain.coefficientMm = new short[(int) cells];
            java.util.Arrays.fill(terrain.coefficientMm, terrain_t.UNKNOWN);
            terrainId = message.id;
            terrainUtime = message.utime;
        }
        terrain.T_odom_level = PlanarPose.of(message.T_odom_level);
        terrain.cornerX = message.p_level_corner[0];
        terrain.cornerY = message.p_level_corner[1];
        terrain.cellM = message.cell_m;
        terrain.columns = message.columns;
        terrain.rows = message.rows;
        for (int i = 0; i < message.n_cells; ++i) {
            int cell = message.first_cell + i;
            if (cell < 0 || cell >= terrain.ground.length) continue;
            terrain.ground[cell] = message.ground[i];
            terrain.coefficientMm[cell] = message.coefficient_mm[i];
        }
    }

    void add(planned_path_t message) {
        path = message;
    }

    void add(cloud_t message) {
        if (message.id != cloudId || message.utime != cloudUtime) cloud.clear();
        cloudId = message.id;
        cloudUtime = message.utime;
        T_odom_cloud = PlanarPose.of(message.T_odom_level);
        for (cloud_line_t line : message.lines) cloud.add(line);
    }

    /** The smallest and largest coordinates in map, {xMin, yMin, xMax, yMax}; null of nothing. */
    double[] bounds() {
        double[] box = {Double.MAX_VALUE, Double.MAX_VALUE, -Double.MAX_VALUE, -Double.MAX_VALUE};
        for (Map.Entry<Integer, LocalMap> map : localMaps.entrySet()) {
            PlanarPose pose = poseOf(map.getKey());
            if (pose == null) continue;
            float[] points = map.getValue().points(mounts);
            for (int i = 0; i < points.length; i += 2) {
                extend(box, pose.transform(points[i], points[i + 1]));
            }
        }
        for (PlanarPose pose : poses) {
            if (pose != null) extend(box, new double[] {pose.x, pose.y});
        }
        if (terrain != null) {
            PlanarPose T_map_level = T_map_odom.times(terrain.T_odom_level);
            for (int i = 0; i < 4; ++i) {
                extend(box, T_map_level.transform(
                        terrain.cornerX + (i % 2) * terrain.columns * terrain.cellM,
                        terrain.cornerY + (i / 2) * terrain.rows * terrain.cellM));
            }
        }
        if (path != null) {
            for (path_point_t point : path.points) {
                extend(box, T_map_odom.transform(point.T_odom_body[0], point.T_odom_body[1]));
            }
        }
        if (T_odom_body != null) extend(box, T_map_odom.transform(T_odom_body.x, T_odom_body.y));
        return box[0] > box[2] ? null : box;
    }

    /** T_map_local; null of a local map that is not in the graph yet. */
    PlanarPose poseOf(int localMap) {
        return localMap >= 0 && localMap < poses.length ? poses[localMap] : null;
    }

    private static void extend(double[] box, double[] point) {
        if (!Double.isFinite(point[0]) || !Double.isFinite(point[1])) return;
        box[0] = Math.min(box[0], point[0]);
        box[1] = Math.min(box[1], point[1]);
        box[2] = Math.max(box[2], point[0]);
        box[3] = Math.max(box[3], point[1]);
    }

    private static float[] pointsOf(Iterable<local_scan_t[]> fragments, LaserMounts mounts) {
        List<float[]> points = new ArrayList<>();
        for (local_scan_t[] scans : fragments) {
            for (local_scan_t scan : scans) {
                PlanarPose T_local_laser =
                        PlanarPose.of(scan.T_local_body).times(mounts.ofChannel(scan.channel));
                double max = mounts.rangeMaxM(scan.channel);
                for (int i = 0; i < scan.nranges; ++i) {
                    float range = scan.ranges[i];
                    if (!(range > 0.05 && range < max)) continue;
                    double angle = scan.angle_min_rad + i * scan.angle_step_rad;
                    double[] p = T_local_laser.transform(range * Math.cos(angle),
                            range * Math.sin(angle));
                    points.add(new float[] {(float) p[0], (float) p[1]});
                }
            }
        }
        float[] flat = new float[2 * points.size()];
        for (int i = 0; i < points.size(); ++i) {
            flat[2 * i] = points.get(i)[0];
            flat[2 * i + 1] = points.get(i)[1];
        }
        return flat;
    }
}
