// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
package adit.viewer;

import adit.cloud_t;
import adit.local_map_t;
import adit.map_request_t;
import adit.planned_path_t;
import adit.pose_graph_t;
import adit.terrain_t;
import java.awt.BorderLayout;
import java.awt.FlowLayout;
import java.awt.event.ActionEvent;
import java.awt.event.WindowAdapter;
import java.awt.event.WindowEvent;
import java.util.concurrent.atomic.AtomicLong;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JButton;
import javax.swing.JCheckBox;
import javax.swing.JDesktopPane;
import javax.swing.JFrame;
import javax.swing.JPanel;
import javax.swing.SwingUtilities;
import javax.swing.Timer;
import lcm.lcm.LCM;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;

/**
 * Draws the mine within lcm-spy: local maps at the poses of the pose graph, the newest terrain map,
 * path and 3D scan, and the robot. It listens from the start of lcm-spy, so that a window that is
 * opened later has all since then; the local maps of before come on request.
 */
public final class MinePlugin implements SpyPlugin {
    private static final int REPAINT_MS = 200;

    private final MineScene scene = new MineScene();
    private final AtomicLong changes = new AtomicLong();

    public MinePlugin() {
        LCM lcm = LCM.getSingleton();
        ReceiveBuffer.enlarge(lcm);
        new SceneSubscriber(scene, changes::incrementAndGet).subscribe(lcm);
    }

    @Override
    public boolean canHandle(long fingerprint) {
        return fingerprint == local_map_t.LCM_FINGERPRINT
                || fingerprint == pose_graph_t.LCM_FINGERPRINT
                || fingerprint == terrain_t.LCM_FINGERPRINT
                || fingerprint == planned_path_t.LCM_FINGERPRINT
                || fingerprint == cloud_t.LCM_FINGERPRINT;
    }

    @Override
    public Action getAction(JDesktopPane desktop, ChannelData channel) {
        return new AbstractAction("Draw the mine") {
            @Override
            public void actionPerformed(ActionEvent event) {
                SwingUtilities.invokeLater(MinePlugin.this::open);
            }
        };
    }

    /** Mapping publishes all local maps again. */
    private void requestMap() {
        map_request_t message = new map_request_t();
        synchronized (scene) {
            message.utime = scene.utime;
        }
        message.requested_by = "lcm-spy";
        LCM.getSingleton().publish("MAP_REQUEST", message);
    }

    private void open() {
        MinePanel panel = new MinePanel(scene);
        JPanel choice = new JPanel(new FlowLayout(FlowLayout.LEFT));
        for (MinePanel.Layer layer : MinePanel.Layer.values()) {
            JCheckBox box = new JCheckBox(layer.label, true);
            box.addActionListener(event -> panel.show(layer, box.isSelected()));
            choice.add(box);
        }
        JButton request = new JButton("request earlier local maps");
        request.addActionListener(event -> requestMap());
        choice.add(request);
        JFrame frame = new JFrame("Mine");
        frame.setLayout(new BorderLayout());
        frame.add(choice, BorderLayout.NORTH);
        frame.add(panel, BorderLayout.CENTER);
        frame.setDefaultCloseOperation(JFrame.DISPOSE_ON_CLOSE);
        frame.pack();
        AtomicLong drawn = new AtomicLong(changes.get());
        Timer timer = new Timer(REPAINT_MS, event -> {
            if (drawn.getAndSet(changes.get()) != changes.get()) panel.repaint();
        });
        timer.start();
        frame.addWindowListener(new WindowAdapter() {
            @Override
            public void windowClosed(WindowEvent event) {
                timer.stop();
            }
        });
        frame.setVisible(true);
    }
}
