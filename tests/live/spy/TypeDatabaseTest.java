// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
import java.io.BufferedReader;
import java.io.InputStreamReader;
import java.util.Arrays;
import lcm.lcm.LCMDataOutputStream;
import lcm.lcm.LCMEncodable;
import lcm.spy.LCMTypeDatabase;

/**
 * Checks that lcm-spy finds each type on standard input (one line "name fingerprint message" per
 * type, from C++) in the jars of CLASSPATH, and that it decodes the message, in hexadecimal digits
 * with a seal behind it. Exit code 1 if a type is missing or decodes as something else.
 */
public class TypeDatabaseTest {
    private static final int SEAL_BYTES = 48;

    private static byte[] bytes(String hex) {
        byte[] bytes = new byte[hex.length() / 2];
        for (int i = 0; i < bytes.length; ++i) {
            bytes[i] = (byte) Integer.parseInt(hex.substring(2 * i, 2 * i + 2), 16);
        }
        return bytes;
    }

    /** Whether the fields are those in front of the seal: encoded again, they are the same bytes. */
    private static boolean decodes(Class<?> type, byte[] sealed) throws Exception {
        LCMEncodable message = (LCMEncodable) type.getConstructor(byte[].class).newInstance(sealed);
        LCMDataOutputStream output = new LCMDataOutputStream();
        message.encode(output);
        return Arrays.equals(output.toByteArray(),
                Arrays.copyOf(sealed, sealed.length - SEAL_BYTES));
    }

    public static void main(String[] arguments) throws Exception {
        LCMTypeDatabase database = new LCMTypeDatabase();
        BufferedReader lines = new BufferedReader(new InputStreamReader(System.in));
        int found = 0;
        int missing = 0;
        for (String line = lines.readLine(); line != null; line = lines.readLine()) {
            String[] fields = line.split(" ");
            Class<?> type = database.getClassByFingerprint(Long.parseLong(fields[1]));
            boolean matches = type != null && type.getName().equals(fields[0])
                    && decodes(type, bytes(fields[2]));
            System.out.println((matches ? "found " : "MISSING ") + fields[0]);
            found += matches ? 1 : 0;
            missing += matches ? 0 : 1;
        }
        System.exit(found > 0 && missing == 0 ? 0 : 1);
    }
}
