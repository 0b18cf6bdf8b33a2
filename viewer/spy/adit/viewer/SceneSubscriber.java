// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
package adit.viewer;

import adit.cloud_t;
import adit.config_t;
import adit.local_map_t;
import adit.map_correction_t;
import adit.planned_path_t;
import adit.pose_graph_t;
import adit.pose_t;
import adit.terrain_t;
import java.io.IOException;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;
import lcm.lcm.LCMSubscriber;

/** Decodes the messages of the channels that a scene shows; skips those of another version. */
final class SceneSubscriber implements LCMSubscriber {
    private static final String[] CHANNELS = {"CLOUD", "CONFIG", "LOCAL_MAP", "MAP_CORRECTION",
        "PATH", "POSE", "POSE_GRAPH", "TERRAIN"};

    private final MineScene scene;
    private final Runnable changed;

    /** The scene is locked while it changes; `changed` is called after that. */
    SceneSubscriber(MineScene scene, Runnable changed) {
        this.scene = scene;
        this.changed = changed;
    }

    void subscribe(LCM lcm) {
        for (String channel : CHANNELS) lcm.subscribe(channel, this);
    }

    @Override
    public void messageReceived(LCM lcm, String channel, LCMDataInputStream input) {
        try {
            synchronized (scene) {
                add(channel, input);
            }
        } catch (IOException | RuntimeException rejected) {
            return;  // of another version, or damaged: lcm-spy itself counts these
        }
        changed.run();
    }

    private void add(String channel, LCMDataInputStream input) throws IOException {
        switch (channel) {
            case "CLOUD": scene.add(new cloud_t(input)); break;
            case "CONFIG": scene.add(new config_t(input)); break;
            case "LOCAL_MAP": scene.add(new local_map_t(input)); break;
            case "MAP_CORRECTION": scene.add(new map_correction_t(input)); break;
            case "PATH": scene.add(new planned_path_t(input)); break;
            case "POSE": scene.add(new pose_t(input)); break;
            case "POSE_GRAPH": scene.add(new pose_graph_t(input)); break;
            case "TERRAIN": scene.add(new terrain_t(input)); break;
            default: break;
        }
    }
}
