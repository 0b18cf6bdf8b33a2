// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
import java.io.BufferedReader;
import java.io.InputStreamReader;
import lcm.spy.LCMTypeDatabase;

/**
 * Checks that lcm-spy finds each type on standard input (one line "name fingerprint" per type, from
 * C++) in the jars of CLASSPATH. Exit code 1 if a type is missing.
 */
public class TypeDatabaseTest {
    public static void main(String[] arguments) throws Exception {
        LCMTypeDatabase database = new LCMTypeDatabase();
        BufferedReader lines = new BufferedReader(new InputStreamReader(System.in));
        int found = 0;
        int missing = 0;
        for (String line = lines.readLine(); line != null; line = lines.readLine()) {
            String[] fields = line.split(" ");
            Class<?> type = database.getClassByFingerprint(Long.parseLong(fields[1]));
            boolean matches = type != null && type.getName().equals(fields[0]);
            System.out.println((matches ? "found " : "MISSING ") + line);
            found += matches ? 1 : 0;
            missing += matches ? 0 : 1;
        }
        System.exit(found > 0 && missing == 0 ? 0 : 1);
    }
}
