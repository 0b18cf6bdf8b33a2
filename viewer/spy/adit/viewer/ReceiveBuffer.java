// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
package adit.viewer;

import java.io.IOException;
import java.lang.reflect.Field;
import java.net.DatagramSocket;
import java.util.Collection;
import lcm.lcm.LCM;

/**
 * Enlarges the receive buffer of LCM's socket. LCM for Java leaves the default of the system, in
 * which a terrain map or a 3D scan, a burst of fragments, does not fit; C++ programs ask for 4 MB. The
 * system grants up to net.core.rmem_max (deploy/sysctl).
 */
final class ReceiveBuffer {
    private static final int BYTES = 4 << 20;

    private ReceiveBuffer() {}

    /** False if this LCM has no such socket: of another transport or version. */
    static boolean enlarge(LCM lcm) {
        boolean found = false;
        try {
            for (Object provider : (Collection<?>) field(lcm, "providers")) {
                Object socket = field(provider, "sock");
                if (!(socket instanceof DatagramSocket)) continue;
                ((DatagramSocket) socket).setReceiveBufferSize(BYTES);
                found = true;
            }
        } catch (ReflectiveOperationException | IOException | RuntimeException unknown) {
            return false;
        }
        return found;
    }

    private static Object field(Object object, String name) throws ReflectiveOperationException {
        Field field = object.getClass().getDeclaredField(name);
        field.setAccessible(true);
        return field.get(object);
    }
}
