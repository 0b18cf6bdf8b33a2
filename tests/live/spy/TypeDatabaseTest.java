// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
import java.io.BufferedReader;
import java.io.InputStreamReader;
import lcm.spy.LCMTypeDatabase;

/**
 * Whether lcm-spy finds each type of standard input ("name fingerprint" a line, from the C++ side)
 * in the jars of CLASSPATH. Ends with 1 if not.
 */
public class TypeDatabaseTest {
    public static void main(String[] arguments) throws Exception {
        LCMTypeDatabase database = new LCMTypeDatabase();
        BufferedReader lines = new BufferedReader(new InputStreamReader(System.in));
        int found = 0;
        int missing = 0;
        for (String line = lines.readLine(); line != null; line = lines.readLine()) {
            String[] words = line.split(" ");
            Class<?> type = database.getClassByFingerprint(Long.parseLong(words[1]));
            boolean known = type != null && type.getName().equals(words[0]);
            System.out.println((known ? "found " : "MISSING ") + line);
            found += known ? 1 : 0;
            missing += known ? 0 : 1;
        }
        System.exit(found > 0 && missing == 0 ? 0 : 1);
    }
}
